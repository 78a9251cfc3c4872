#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/json/json.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

/// Values of all_quantities(), in their order: nullopt where it was not measured, or not decided.
using Values = std::vector<std::optional<double>>;
inline Values no_values() { return Values(all_quantities().size()); }

/// A state's place above jamming and its quantities, those of replicates left out.
struct StateValues {
  double delta_phi = 0;
  Values values = no_values();
};

/// The part of a record that a table needs.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordSummary {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;
  int replicate = 0;
  std::string manifest_digest;
  /// The record before measures were added to it, and the build that added them.
  struct Before {
    std::string manifest_digest, result_digest, added_by;
  };
  std::vector<Before> before;
  std::vector<Measure> measures;  ///< that it has, of those that this version knows
  Json settings;                  ///< protocol, minimiser and measure
  std::string build;              ///< version, sources and compiler of the program that made it
  std::string result_digest;      ///< of all but timing and provenance: equal for two runs of the same replicate
  double cpu_seconds = 0;
  bool failed = false, flagged = false;
  std::vector<Flag> flags;          ///< of those that it is flagged with, the ones that this version knows
  Values values = no_values();      ///< of the replicate, and of its state nearest jamming
  std::vector<StateValues> states;  ///< above jamming, in order of Δφ
  std::optional<double> residual;   ///< worst of the states behind φ_J
};

/// True if the replicate has one of these flags.
bool has_any(const RecordSummary& summary, const std::vector<Flag>& flags);

/// Throws InputError if the record is not one of ours or lacks what a table needs.
RecordSummary summarise_record(const Json& record, const std::string& file);

}  // namespace isojam
