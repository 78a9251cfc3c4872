#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/rigidity/rigidity.hpp"
#include "tasks/io/describe.hpp"

// The rank of a rigidity matrix in records.

namespace isojam {

struct Rank {
  Reasoned<int> constraints, rank, self_stress, floppy;
  std::optional<double> tolerance, least_kept, largest_dropped;  ///< absent if the constraints are unknown
};

/// `name` is the ending of the names of the quantities, `letter` that of their symbols, and `condition` states which
/// constraints there are.
void describe_rank(Fields& field, Rank& rank, const std::string& name, const std::string& letter,
                   const std::string& condition);
Rank rank_of(const RigidityMatrix& matrix, const RigidityOptions& options = {});
Rank no_rank(std::string_view why);

}  // namespace isojam
