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

inline constexpr std::string_view record_schema = "isojam.replicate.v2";
inline constexpr std::string_view path_schema = "isojam.path.v1";
inline constexpr std::string_view packing_schema = "isojam.packing.v2";

/// The record of an outcome that was not interrupted. Only `timing` may differ between two runs of the same replicate
/// by the same build.
Json make_record(const Outcome& outcome);

/// The state nearest jamming of an outcome without failure.
Json make_packing(const Outcome& outcome);
/// Every state of the expansion, in order, each with its Δφ.
Json make_path(const Outcome& outcome);

/// Parts of records and checkpoints alike.
Json provenance(const ReplicateSpec& spec);
Json to_json(const Timing& timing);
Json to_json(const PairCounts& counts);
Json to_json(const MinimiseWork& work);

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
  Json settings;              ///< protocol, minimiser and measure
  std::string result_digest;  ///< of all but timing and provenance: equal for two runs of the same replicate
  double cpu_seconds = 0;
  bool failed = false, flagged = false;
  Values values;                    ///< of the replicate, and of its state nearest jamming
  std::vector<StateValues> states;  ///< above jamming, in order of Δφ
  std::optional<double> residual;   ///< worst of the states behind φ_J
};

/// Throws InputError if the record is not one of ours or lacks what a table needs.
RecordSummary summarise_record(const Json& record, const std::string& file);

}  // namespace isojam
