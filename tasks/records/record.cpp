#include "tasks/records/record.hpp"

#include <algorithm>
#include <cassert>

#include "tasks/io/hash.hpp"
#include "tasks/io/version.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/measure/rearrangements.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/records/state_file.hpp"
#include "tasks/records/work_json.hpp"

namespace isojam {
namespace {

constexpr std::string_view no_result = "the replicate failed";
constexpr std::string_view at_zero_pressure = "the packing is at zero pressure; phi_0 takes the place of phi_j";

void put_distance(Json& json, double density, const JamResult& jam) {
  if (jam.phi_j) {
    put_number(json, "delta_phi", density - jam.phi_j->density);
  } else {
    put_absent(json, "delta_phi", "no jamming point");
  }
}

Json step_record(const JamStep& step, const JamResult& jam) {
  Json json;
  json["stage"] = to_string(step.stage);
  put_number(json, "phi", step.density);
  put_distance(json, step.density, jam);
  put_number(json, "energy_per_particle", step.energy_per_particle);
  put_number(json, "pressure", step.pressure);
  put_number(json, "deviator", step.deviator);
  put_number(json, "residual", step.summary.residual);
  put_number(json, "residual_floor", step.summary.residual_floor);
  json["stopped"] = to_string(step.summary.reason);
  json["evaluations"] = step.summary.evaluations;
  json["iterations"] = step.summary.iterations;
  json["descents"] = step.descents;
  if (step.rearrangement) json["rearrangement"] = to_json(*step.rearrangement);
  if (step.lost) json["lost"] = true;
  return json;
}

Json state_record(const Outcome& outcome, std::size_t index) {
  const auto& jam = outcome.jam;
  auto json = step_record(jam.path[jam.state_steps[index]], jam);
  json.erase("stage");
  json.erase("evaluations");
  json.erase("iterations");
  json["step"] = jam.state_steps[index];
  for (const auto& [what, measurement] : outcome.measured) json.update(measurement.states.at(index));
  return json;
}

/// The training cycles. Their contact numbers are in the part of the measure `contacts`.
void put_cycles(Json& record, const std::vector<Cycle>& cycles) {
  for (const Cycle& cycle : cycles) {
    Json json;
    put_number(json, "energy_per_particle", cycle.energy_per_particle);
    put_optional(json, "phi_j", cycle.phi_j, "fewer than two states");
    record["cycles"].push_back(std::move(json));
  }
}

double worst_residual(const JamResult& jam) {
  double worst = 0;
  for (const int state : jam.phi_j->states) {
    const double residual = jam.path[jam.state_steps[state]].summary.residual;
    // written so that a NaN counts as the worst and is reported
    if (!(residual <= worst)) worst = residual;
  }
  return worst;
}

void put_jamming_point(Json& record, const JamResult& jam) {
  if (jam.status == JamStatus::zero_pressure) {
    const std::size_t state = *nearest_state(jam);
    record["phi_0"] = jam.states[state].density();
    Json& json = record["phi_j"];
    for (const auto* key : {"phi_j", "standard_error", "ci95_half_width", "single_state", "exponent"})
      put_absent(json, key, at_zero_pressure);
    put_number(json, "residual", jam.path[static_cast<std::size_t>(jam.state_steps[state])].summary.residual);
    json["states"] = Json::array();
    return;
  }
  const auto& point = *jam.phi_j;
  Json& json = record["phi_j"];
  put_number(json, "phi_j", point.density);
  const auto put_fitted = [&](const std::string& key, double value, std::string_view reason) {
    if (value != 0) {
      put_number(json, key, value);
    } else {
      put_absent(json, key, reason);
    }
  };
  put_fitted("standard_error", point.standard_error, "two states leave no degree of freedom");
  put_fitted("ci95_half_width", point.ci95_half_width, "two states leave no degree of freedom");
  put_number(json, "single_state", point.single_state);
  put_fitted("exponent", point.exponent, "a free exponent could not be fitted");
  put_number(json, "residual", worst_residual(jam));
  json["states"] = point.states;
}

RecordIdentity identity(const Outcome& outcome, const std::string& result_digest) {
  return {replicate_name(outcome.spec), outcome.spec.manifest_digest, result_digest};
}

/// Adds the keys of a complete record to a failed one, except flags. Their values are null, with the reason.
void put_nothing(Json& record, const std::vector<Measure>& measures) {
  std::vector<std::string> keys{"phi_j", "nearest"};
  for (const auto& quantity : all_quantities()) {
    if (quantity.of != Quantity::Of::replicate || quantity.cohesive) continue;
    const auto& measure = quantity.measure;
    if (measure && std::find(measures.begin(), measures.end(), *measure) == measures.end()) continue;
    keys.emplace_back(quantity.pointer.substr(1, quantity.pointer.find('/', 1) - 1));
  }
  for (const auto& key : keys) put_absent(record, key, no_result);
}

}  // namespace

Json provenance(const ReplicateSpec& spec) {
  Json json;
  json["version"] = version();
  json["git"] = git_hash();
  json["compiler"] = compiler();
  json["manifest_digest"] = spec.manifest_digest;
  json["seed"] = spec.seed;
  if (spec.start) json["start"] = spec.start->files[static_cast<std::size_t>(spec.replicate)].path;
  return json;
}

Json to_json(const Timing& timing) {
  return {{"wall_seconds", timing.wall_seconds}, {"cpu_seconds", timing.cpu_seconds}};
}

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

Json make_record(const Outcome& outcome) {
  assert(!outcome.interrupted);
  const auto& jam = outcome.jam;
  Json json;
  json["schema"] = record_schema;
  json["provenance"] = provenance(outcome.spec);
  json["spec"] = to_json(outcome.spec);
  json["status"] = outcome.failure ? "failed" : "done";
  if (outcome.failure) {
    json["failure"] = {{"where", outcome.failure->where}, {"why", outcome.failure->why}};
    put_absent(json, "flags", no_result);
  } else {
    json["flags"] = flags_of(outcome);
  }
  json["timing"] = to_json(outcome.timing);
  json["timing"]["stages"] = outcome.stage_seconds;
  json["evaluations"] = jam.evaluations;
  json["pairs"] = to_json(jam.counts);
  json["work"] = to_json(jam.work);
  if (outcome.failure) {
    put_nothing(json, outcome.spec.measures);
  } else {
    put_jamming_point(json, jam);
    json["nearest"] = state_record(outcome, *nearest_state(jam));
    for (const auto& [what, measurement] : outcome.measured) {
      json.update(measurement.replicate);
      if (measurement.nearest_only) json["nearest_only"].push_back(to_string(what));
    }
    json.update(written(rearrangement_part(jam.path)));
    put_cycles(json, jam.cycles);
  }
  json["states"] = Json::array();
  for (std::size_t i = 0; i < jam.states.size(); ++i) json["states"].push_back(state_record(outcome, i));
  json["path"] = Json::array();
  for (const auto& step : jam.path) json["path"].push_back(step_record(step, jam));
  json["result_digest"] = result_digest(json);
  return json;
}

Json with_added(Json record, const Json& before, const std::vector<Measure>& added) {
  const auto now = record.at("provenance");
  Json addition;
  addition["measures"] = Json::array();
  for (const auto measure : added) addition["measures"].push_back(to_string(measure));
  for (const auto* key : {"version", "git", "compiler"}) addition[key] = now.at(key);
  addition["before"]["manifest_digest"] = before.at("provenance").at("manifest_digest");
  addition["before"]["result_digest"] = before.at("result_digest");
  auto provenance = before.at("provenance");
  provenance["manifest_digest"] = now.at("manifest_digest");
  provenance["added"].push_back(std::move(addition));
  record["provenance"] = std::move(provenance);
  auto timing = before.at("timing");
  for (const auto* key : {"wall_seconds", "cpu_seconds"})
    timing[key] = timing.at(key).get<double>() + record.at("timing").at(key).get<double>();
  for (const auto measure : added) {
    const std::string name(to_string(measure));
    const auto& stages = record.at("timing").at("stages");
    if (stages.contains(name)) timing["stages"][name] = stages.at(name);
  }
  record["timing"] = std::move(timing);
  return record;
}

Json failed_record(const Json& before, const ReplicateSpec& spec) {
  Json json;
  for (const auto* key : {"schema", "provenance", "spec", "status", "failure", "flags", "flags_reason", "timing",
                          "evaluations", "pairs", "work"}) {
    json[key] = before.at(key);
  }
  json["provenance"]["manifest_digest"] = spec.manifest_digest;
  json["spec"] = to_json(spec);
  put_nothing(json, spec.measures);
  json["states"] = before.at("states");
  json["path"] = before.at("path");
  json["result_digest"] = result_digest(json);
  return json;
}

Json make_packing(const Outcome& outcome, const std::string& result_digest) {
  assert(!outcome.failure && !outcome.interrupted);
  auto json = state_file_head(packing_schema, identity(outcome, result_digest));
  json.update(to_json(outcome.jam.states[*nearest_state(outcome.jam)]));
  return json;
}

Json make_path(const Outcome& outcome, const std::string& result_digest) {
  assert(!outcome.failure && !outcome.interrupted);
  auto json = state_file_head(path_schema, identity(outcome, result_digest));
  json["states"] = Json::array();
  for (const auto& packing : outcome.jam.states) {
    Json state;
    put_distance(state, packing.density(), outcome.jam);
    state.update(to_json(packing));
    json["states"].push_back(std::move(state));
  }
  return json;
}

}  // namespace isojam
