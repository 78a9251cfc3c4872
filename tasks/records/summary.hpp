#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/io/json.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

/// Values of all_quantities(), in the same order. nullopt if a quantity was not measured or could not be computed.
using Values = std::vector<std::optional<double>>;
inline Values no_values() { return Values(all_quantities().size()); }

/// The distance of a state to jamming, and the values of its quantities. Quantities of replicates have no value here.
struct StateValues {
  double delta_phi = 0;
  Values values = no_values();
};

/// The part of a record that tables need.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordSummary {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;
  int replicate = 0;
  std::string manifest_digest;
  /// The digests of a record before measures were added, and the build that added the measures.
  struct Before {
    std::string manifest_digest, result_digest, added_by;
  };
  std::vector<Before> before;
  std::vector<Measure> measures;  ///< measures in the record that this version of isojam knows
  Json settings;                  ///< settings of protocol, minimiser and measure
  std::string build;              ///< version, commit and compiler of the program that made the record
  /// digest of the record without timing and provenance; two runs of the same replicate have the same digest
  std::string result_digest;
  double cpu_seconds = 0;
  bool failed = false, flagged = false;
  std::vector<Flag> flags;          ///< flags of the replicate that this version of isojam knows
  Values values = no_values();      ///< quantities of the replicate, and of its state nearest jamming
  std::vector<StateValues> states;  ///< states with Δφ > 0, in the order of Δφ
  std::optional<double> residual;   ///< largest residual of the states that were used to fit φ_J
};

/// True if the replicate has one of these flags.
bool has_any(const RecordSummary& summary, const std::vector<Flag>& flags);

/// Reads the summary of a record. Throws InputError if the document is not a record of isojam, or if values that a
/// table needs are missing.
RecordSummary summarise_record(const Json& record, const std::string& file);

}  // namespace isojam
