#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "tasks/json_text.hpp"
#include "tasks/replicate.hpp"

namespace isojam {

inline constexpr std::string_view record_schema = "isojam.replicate.v1";
inline constexpr std::string_view packing_schema = "isojam.packing.v1";

/// A quantity that tables average over replicates.
struct Column {
  std::string_view name;     ///< key in records and tables: the paper's symbol
  std::string_view section;  ///< object of the record that holds it
  std::string_view latex;
};

inline constexpr std::array columns{
    Column{"phi_j", "phi_j", "\\phi_J"}, Column{"Z", "nearest", "Z"},     Column{"Z_ff", "nearest", "Z_{ff}"},
    Column{"Z_ef", "nearest", "Z_{ef}"}, Column{"Z_l", "nearest", "Z_l"}, Column{"C", "nearest", "C"},
};

/// The record of an outcome that was not interrupted. Only `timing` may differ between two runs of the same replicate
/// by the same build.
Json make_record(const Outcome& outcome);

/// The state nearest jamming of an outcome without failure: cell side, positions, quaternions (w, x, y, z), and the low
/// parts of both (see Pose), without which it would not be an equilibrium to more than 1e-8 or so.
Json make_packing(const Outcome& outcome);

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
  std::array<std::optional<double>, columns.size()> values;  ///< nullopt: not measured, or not decided
  std::optional<double> residual;                            ///< worst of the states behind φ_J
};

/// Throws InputError if the record is not one of ours or lacks what a table needs.
RecordSummary summarise_record(const Json& record, const std::string& file);

}  // namespace isojam
