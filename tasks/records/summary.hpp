#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/alignment/angle_histogram.hpp"
#include "engine/packing/mixture/mixture.hpp"
#include "tasks/io/json.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/document.hpp"

namespace isojam {

/// Values of all_quantities(), in the same order. A value is nullopt if the quantity was not measured or could not be
/// computed.
using Values = std::vector<std::optional<double>>;
inline Values no_values() { return Values(all_quantities().size()); }

/// Values of the quantities of one state, and its distance to jamming. Quantities that have one value per replicate are
/// nullopt here.
struct StateValues {
  double delta_phi = 0;
  Values values = no_values();
  std::optional<AngleHistogram> angles = std::nullopt;  ///< nullopt if the record lacks it
};

/// The part of a record that tables need.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordSummary {
  Mixture solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;
  int replicate = 0;
  std::uint64_t seed = 0;
  std::string spec_digest;  ///< see spec_digest()
  /// Identifies the random numbers or the file from which replicates with the same number start. Such replicates are
  /// compared with each other.
  std::string study;
  /// The digests of a record before measures were added, and the build that added them.
  struct Before {
    std::string spec_digest, result_digest, added_by;
  };
  /// one element for each time that measures were added
  std::vector<Before> before;
  std::vector<Measure> measures;
  std::vector<Measure> nearest_only;  ///< measures whose values are only those of the nearest state
  Json settings;                      ///< protocol, minimiser, modes; also shear if it was measured
  std::string build;                  ///< version, commit and compiler of the program that made the record
  /// result_digest() of the record; two records with the same result have the same digest
  std::string result_digest;
  double cpu_seconds = 0;
  bool failed = false, flagged = false;
  bool reached_limit = false;  ///< failed, because compression reached max_density
  std::vector<Flag> flags;
  Values values = no_values();           ///< quantities of the replicate, and quantities of its nearest state
  std::optional<AngleHistogram> angles;  ///< of the nearest state; nullopt if the record lacks it
  std::vector<StateValues> states;       ///< states with Δφ > 0, sorted by Δφ
  std::optional<double> residual;        ///< largest residual of the states that were used to fit φ_J
};

/// True if the replicate has at least one of these flags.
bool has_any(const RecordSummary& summary, const std::vector<Flag>& flags);

/// Reads a record. Throws one InputError with all errors if the document is not a record of this format.
Record read_record_document(const Json& json, const std::string& file);

/// The summary of a record. `json` is its document. Throws InputError if a value that tables need is missing.
RecordSummary summarise_record(const Record& record, const Json& json, const std::string& file);
RecordSummary summarise_record(const Json& json, const std::string& file);

}  // namespace isojam
