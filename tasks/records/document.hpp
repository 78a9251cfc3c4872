#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tasks/io/describe.hpp"
#include "tasks/measure/measure.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/records/step_fields.hpp"

// The document of a record. describe(Fields&, Record&) is its only description: records are written, read and checked
// through it, and their schema and the list of their fields follow from it.

namespace isojam {

/// An addition of measures to a record.
struct Addition {
  std::vector<Measure> measures;
  std::string version, git, compiler;
  std::string spec_digest, result_digest;  ///< before the addition
};
void describe(Fields& field, Addition& addition);

/// The build, the specification and the seed that produced a record or a checkpoint.
struct Provenance {
  std::string version, git, compiler, spec_digest;
  std::optional<int> protocol;  ///< protocol_version; nullopt in records of version 1
  std::uint64_t seed = 0;
  std::optional<std::string> start;  ///< file of the initial configuration
  std::optional<std::vector<Addition>> added;
};
void describe(Fields& field, Provenance& provenance);
/// The provenance of a replicate that this build computes.
Provenance provenance_of(const ReplicateSpec& spec);

/// The fit that gives φ_J.
struct RecordedPoint {
  Reasoned<> phi_j, standard_error, ci95_half_width, single_state, exponent;
  double residual = 0;
  std::vector<int> states;
};
void describe(Fields& field, RecordedPoint& point);

struct RecordedCycle {
  double energy_per_particle = 0;
  Reasoned<> phi_j;
};
void describe(Fields& field, RecordedCycle& cycle);

/// A state of the decompression with the results of all measures.
struct StateRow {
  JamStep step;
  Reasoned<> delta_phi{std::nullopt, "no jamming point"};
  int index = 0;                   ///< of the step in the path
  Json measured = Json::object();  ///< the part of each measure, under its name; empty if the record was read
};
void describe(Fields& field, StateRow& row);

enum class RecordStatus : std::uint8_t { done, failed };
template <>
inline constexpr std::array enum_names<RecordStatus>{EnumName{RecordStatus::done, "done"},
                                                     EnumName{RecordStatus::failed, "failed"}};

struct Record {
  std::string schema;
  std::optional<std::string> checksum;
  Provenance provenance;
  Json spec = Json::object();  ///< see to_json(const ReplicateSpec&)
  RecordStatus status = RecordStatus::done;
  std::optional<Failure> failure;
  Reasoned<std::vector<Flag>> flags;
  Timing timing;
  std::map<std::string, double> stage_seconds;
  long evaluations = 0;
  PairCounts pairs;
  MinimiseWork work;
  Reasoned<RecordedPoint> phi_j;
  std::optional<double> phi_0;
  Reasoned<int> nearest;           ///< index in `states`
  Json measured = Json::object();  ///< results of measures from several states, and the rearrangements
  std::optional<std::vector<Measure>> nearest_only;
  std::optional<std::vector<RecordedCycle>> cycles;
  std::vector<StateRow> states;
  std::vector<StepRow> path;
  std::string result_digest;
};
void describe(Fields& field, Record& record);

}  // namespace isojam
