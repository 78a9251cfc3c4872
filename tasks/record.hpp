#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/columns.hpp"
#include "tasks/json_text.hpp"
#include "tasks/replicate.hpp"

namespace isojam {

inline constexpr std::string_view record_schema = "isojam.replicate.v1";
inline constexpr std::string_view packing_schema = "isojam.packing.v1";

/// The record of an outcome that was not interrupted. Only `timing` may differ between two runs of the same replicate
/// by the same build.
Json make_record(const Outcome& outcome);

/// The state nearest jamming of an outcome without failure: cell side, positions, quaternions (w, x, y, z), and the low
/// parts of both (see Pose), without which it would not be an equilibrium to more than 1e-8 or so.
Json make_packing(const Outcome& outcome);

/// Of each column: nullopt where it was not measured, or not decided.
using Values = std::array<std::optional<double>, all_columns.size()>;

/// A state's place above jamming and its columns, those of replicates left out.
struct StateValues {
  double delta_phi = 0;
  Values values;
};

/// What a table needs of a record.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordSummary {
  SolidKind solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;
  int replicate = 0;
  std::string manifest_digest;
  Json settings;  ///< protocol, minimiser and measure
  Json result;    ///< all but timing and provenance: equal for two runs of the same replicate
  bool failed = false, flagged = false;
  Values values;                    ///< of the replicate, and of its state nearest jamming
  std::vector<StateValues> states;  ///< above jamming, in order of Δφ
  std::optional<double> residual;   ///< worst of the states behind φ_J
};

/// Throws InputError if the record is not one of ours or lacks what a table needs.
RecordSummary summarise_record(const Json& record, const std::string& file);

}  // namespace isojam
