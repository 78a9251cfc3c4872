#include "tasks/records/record.hpp"

#include <algorithm>
#include <cassert>

#include "tasks/io/hash.hpp"
#include "tasks/measure/rearrangements.hpp"
#include "tasks/records/document.hpp"
#include "tasks/records/state_file.hpp"

namespace isojam {
namespace {

constexpr std::string_view no_result = "the replicate failed";
constexpr std::string_view not_relaxed = "the packing was measured as given, and nothing was relaxed";
constexpr std::string_view at_zero_pressure = "the packing is at zero pressure; phi_0 takes the place of phi_j";
constexpr std::string_view no_freedom = "two states leave no degree of freedom";

Reasoned<> distance(double density, const JamResult& jam) {
  if (!jam.phi_j) return {std::nullopt, "no jamming point"};
  return {density - jam.phi_j->density, ""};
}

StepRow step_row(const JamStep& step, const JamResult& jam) { return {step, distance(step.density, jam)}; }

StateRow state_row(const Outcome& outcome, std::size_t index) {
  const auto& jam = outcome.jam;
  const auto step = static_cast<std::size_t>(jam.state_steps[index]);
  StateRow row{jam.path[step], distance(jam.path[step].density, jam), jam.state_steps[index], Json::object()};
  for (const auto& [what, measurement] : outcome.measured) row.measured.update(measurement.states.at(index));
  return row;
}

double worst_residual(const JamResult& jam) {
  double worst = 0;
  for (const int state : jam.phi_j->states) {
    const double residual = jam.path[static_cast<std::size_t>(jam.state_steps[state])].summary.residual;
    // written so that a NaN counts as the worst and is reported
    if (!(residual <= worst)) worst = residual;
  }
  return worst;
}

RecordedPoint fitted_point(const JamResult& jam) {
  const auto& point = *jam.phi_j;
  // The fit states 0 for what it could not determine.
  const auto known = [](double value, std::string_view reason) {
    return reasoned(value != 0 ? std::optional(value) : std::nullopt, reason);
  };
  return {{point.density, ""},
          known(point.standard_error, no_freedom),
          known(point.ci95_half_width, no_freedom),
          {point.single_state, ""},
          known(point.exponent, "a free exponent could not be fitted"),
          worst_residual(jam),
          point.states};
}

RecordedPoint no_point(const JamStep& state, std::string_view reason) {
  const Reasoned<> none{std::nullopt, std::string(reason)};
  return {none, none, none, none, none, state.summary.residual, {}};
}

void set_results(Record& record, const Outcome& outcome) {
  const auto& jam = outcome.jam;
  const std::size_t nearest = *nearest_state(jam);
  record.nearest.value = static_cast<int>(nearest);
  if (jam.status == JamStatus::zero_pressure) {
    record.phi_0 = jam.states[nearest].density();
    record.phi_j.value = no_point(jam.path[static_cast<std::size_t>(jam.state_steps[nearest])], at_zero_pressure);
  } else if (jam.status == JamStatus::as_given) {
    record.phi_j.value = no_point(jam.path.front(), not_relaxed);
  } else {
    record.phi_j.value = fitted_point(jam);
  }
  record.flags.value = flags_of(outcome);
  std::vector<Measure> nearest_only;
  for (const auto& [what, measurement] : outcome.measured) {
    record.measured.update(measurement.replicate);
    if (measurement.nearest_only) nearest_only.push_back(what);
  }
  if (!nearest_only.empty()) record.nearest_only = std::move(nearest_only);
  record.measured.update(written(rearrangement_part(jam.path)));
  if (!jam.cycles.empty()) record.cycles.emplace();
  for (const Cycle& cycle : jam.cycles)
    record.cycles->push_back({cycle.energy_per_particle, reasoned(cycle.phi_j, "fewer than two states")});
}

RecordIdentity identity_of(const Outcome& outcome, const std::string& result_digest) {
  return {replicate_name(outcome.spec), spec_digest(outcome.spec), result_digest};
}

/// The JSON of a record with its digest.
Json with_digest(const Record& record) {
  Json json = written(record);
  json["result_digest"] = result_digest(json);
  return json;
}

}  // namespace

bool is_in_result_digest(std::string_view key) {
  return key != "checksum" && key != "timing" && key != "provenance" && key != "result_digest";
}

std::string result_digest(const Json& record) {
  // Text of the object without the omitted keys, made without copying the object.
  std::string text;
  for (const auto& item : record.items()) {
    const auto& key = item.key();
    if (!is_in_result_digest(key)) continue;
    text += (text.empty() ? '{' : ',') + Json(key).dump() + ':' + item.value().dump();
  }
  return hex_hash(text + '}');
}

Json make_record(const Outcome& outcome) { return with_digest(record_of(outcome)); }

Record record_of(const Outcome& outcome) {
  assert(!outcome.interrupted);
  const auto& jam = outcome.jam;
  Record record;
  record.schema = record_schema;
  record.provenance = provenance_of(outcome.spec);
  record.spec = to_json(outcome.spec);
  record.status = outcome.failure ? RecordStatus::failed : RecordStatus::done;
  record.failure = outcome.failure;
  record.flags.reason = record.phi_j.reason = record.nearest.reason = no_result;
  record.timing = outcome.timing;
  record.stage_seconds = outcome.stage_seconds;
  record.evaluations = jam.evaluations;
  record.pairs = jam.counts;
  record.work = jam.work;
  if (!outcome.failure) set_results(record, outcome);
  for (std::size_t i = 0; i < jam.states.size(); ++i) record.states.push_back(state_row(outcome, i));
  for (const auto& step : jam.path) record.path.push_back(step_row(step, jam));
  return record;
}

Json with_added(Record record, const Record& before, const std::vector<Measure>& added) {
  const Provenance now = record.provenance;
  record.provenance = before.provenance;
  auto& additions = record.provenance.added;
  if (!additions) additions.emplace();
  additions->push_back(
      {added, now.version, now.git, now.compiler, before.provenance.spec_digest, before.result_digest});
  const auto stages = std::exchange(record.stage_seconds, before.stage_seconds);
  for (const auto measure : added) {
    const auto found = stages.find(std::string(to_string(measure)));
    if (found != stages.end()) record.stage_seconds.insert_or_assign(found->first, found->second);
  }
  record.timing.wall_seconds += before.timing.wall_seconds;
  record.timing.cpu_seconds += before.timing.cpu_seconds;
  record.checksum.reset();
  return with_digest(record);
}

Record failed_record(Record before, const ReplicateSpec& spec) {
  before.provenance.spec_digest = spec_digest(spec);
  before.spec = to_json(spec);
  before.timing = {};
  before.stage_seconds.clear();
  return before;
}

Json make_packing(const Outcome& outcome, const std::string& result_digest) {
  assert(!outcome.failure && !outcome.interrupted);
  return written(PackingFile{{std::string(packing_schema), identity_of(outcome, result_digest)},
                             stored(outcome.jam.states[*nearest_state(outcome.jam)])});
}

Json make_path(const Outcome& outcome, const std::string& result_digest) {
  assert(!outcome.failure && !outcome.interrupted);
  PathFile file{{std::string(path_schema), identity_of(outcome, result_digest)}, {}};
  for (const auto& packing : outcome.jam.states)
    file.states.push_back({distance(packing.density(), outcome.jam), stored(packing)});
  return written(file);
}

}  // namespace isojam
