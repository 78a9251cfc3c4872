#pragma once

#include <functional>
#include <optional>
#include <span>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Progress of a sweep point towards its goal.
struct Advance {
  int wanted = 0;  ///< replicates 0 … wanted − 1 are to be recorded; if all are recorded, the point is finished
  bool finished = false;             ///< the goal or max is reached, or none of the first min has a value
  bool met = false;                  ///< the half width was reached; false without a goal
  std::optional<double> half_width;  ///< at the last complete batch
};

/// End of the batch that follows `replicates`: a quarter more, at least two.
int next_batch_end(int replicates, int max);

/// Sequential rule: after min replicates, and after every batch, stop if the 95 % confidence interval (Student t) of
/// the mean over replicates 0 … n − 1 is narrow enough for the goal. `values[r]` belongs to replicate r; it is nullopt
/// if the replicate failed, is excluded or has no value. Pass no value after the first unrecorded replicate. The
/// decision follows the order of replicates, so it does not depend on which finished first. Whole batches are used
/// because an interval that is checked after each replicate meets the goal by chance too often.
Advance advance_of(const Replicates& replicates, std::span<const std::optional<double>> values);

}  // namespace isojam
