#include "tasks/record.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tasks/json_place.hpp"
#include "tasks/packing_json.hpp"
#include "tasks/version.hpp"

namespace isojam {
namespace {

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
  put_number(json, "residual", step.summary.residual);
  put_number(json, "residual_floor", step.summary.residual_floor);
  json["stopped"] = to_string(step.summary.reason);
  json["evaluations"] = step.summary.evaluations;
  json["iterations"] = step.summary.iterations;
  json["descents"] = step.descents;
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

double worst_residual(const JamResult& jam) {
  double worst = 0;
  for (const int state : jam.phi_j->states) {
    const double residual = jam.path[jam.state_steps[state]].summary.residual;
    // Written so that a NaN wins and is reported.
    if (!(residual <= worst)) worst = residual;
  }
  return worst;
}

Json jamming_record(const JamResult& jam) {
  const auto& point = *jam.phi_j;
  Json json;
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
  return json;
}

std::optional<double> number_or_null(const JsonPlace& place) {
  if (place.value().is_null()) return std::nullopt;
  return place.number({-1e300, 1e300});
}

std::optional<double> value_below(const JsonPlace& place, std::string_view pointer) {
  if (pointer.empty()) return number_or_null(place);
  const auto end = std::min(pointer.find('/', 1), pointer.size());
  return value_below(place.at(std::string(pointer.substr(1, end - 1))), pointer.substr(end));
}

/// nullopt if it was not measured, that is, if the first key of its pointer is missing; any other must be there.
std::optional<double> column_value(const JsonPlace& place, const Column& column) {
  // Tables read millions of values: only one that is not as it should be is worth a place with its texts.
  const Json* value = &place.value();
  for (std::string_view rest = column.pointer; !rest.empty();) {
    const auto end = std::min(rest.find('/', 1), rest.size());
    const auto found = value->is_object() ? value->find(rest.substr(1, end - 1)) : value->end();
    if (found == value->end()) {
      if (rest.size() == column.pointer.size()) return std::nullopt;
      return value_below(place, column.pointer);
    }
    value = &*found;
    rest = rest.substr(end);
  }
  if (value->is_number_float()) return value->get<double>();
  return value_below(place, column.pointer);
}

void read_values(const JsonPlace& root, RecordSummary& summary) {
  const auto nearest = root.at("nearest");
  for (std::size_t i = 0; i < all_columns.size(); ++i) {
    const bool of_replicate = all_columns[i].of == Column::Of::replicate;
    summary.values[i] = column_value(of_replicate ? root : nearest, all_columns[i]);
  }
  summary.residual = number_or_null(root.at("phi_j").at("residual"));
}

void read_states(const JsonPlace& states, RecordSummary& summary) {
  const auto count = states.expect_list("a list of states");
  for (std::size_t k = 0; k < count; ++k) {
    const auto state = states.at(k);
    const auto distance = number_or_null(state.at("delta_phi"));
    if (!distance || *distance <= 0) continue;
    StateValues values{*distance, {}};
    for (std::size_t i = 0; i < all_columns.size(); ++i) {
      if (all_columns[i].of == Column::Of::state) values.values[i] = column_value(state, all_columns[i]);
    }
    summary.states.push_back(values);
  }
  std::sort(summary.states.begin(), summary.states.end(),
            [](const StateValues& a, const StateValues& b) { return a.delta_phi < b.delta_phi; });
}

/// Of a record that has neither checksum nor digest yet.
std::string result_digest(const Json& record) {
  auto result = record;
  result.erase("timing");
  result.erase("provenance");
  return hex_hash(result.dump());
}

}  // namespace

Json provenance(const ReplicateSpec& spec) {
  Json json;
  json["version"] = version();
  json["git"] = git_hash();
  json["compiler"] = compiler();
  json["manifest_digest"] = spec.manifest_digest;
  json["seed"] = spec.seed;
  return json;
}

Json to_json(const Timing& timing) {
  return {{"wall_seconds", timing.wall_seconds}, {"cpu_seconds", timing.cpu_seconds}};
}

Json to_json(const PairCounts& counts) {
  Json json;
  json["listed"] = counts.listed;
  json["out_of_reach"] = counts.out_of_reach;
  json["by_axis"] = counts.by_axis;
  json["overlapped"] = counts.overlapped;
  json["clipped"] = counts.clipped;
  json["touching"] = counts.touching;
  return json;
}

Json to_json(const MinimiseWork& work) {
  Json json;
  json["extended_evaluations"] = work.extended_evaluations;
  json["hessians"] = work.hessians;
  json["factorisations"] = work.factorisations;
  json["factor_updates"] = work.factor_updates;
  return json;
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
  } else {
    json["flags"] = flags_of(outcome);
  }
  json["timing"] = to_json(outcome.timing);
  json["timing"]["stages"] = outcome.stage_seconds;
  json["evaluations"] = jam.evaluations;
  json["pairs"] = to_json(jam.counts);
  json["work"] = to_json(jam.work);
  if (!outcome.failure) {
    json["phi_j"] = jamming_record(jam);
    json["nearest"] = state_record(outcome, *nearest_state(jam));
    for (const auto& [what, measurement] : outcome.measured) json.update(measurement.replicate);
  }
  json["states"] = Json::array();
  for (std::size_t i = 0; i < jam.states.size(); ++i) json["states"].push_back(state_record(outcome, i));
  json["path"] = Json::array();
  for (const auto& step : jam.path) json["path"].push_back(step_record(step, jam));
  json["result_digest"] = result_digest(json);
  return json;
}

Json make_packing(const Outcome& outcome) {
  assert(!outcome.failure && !outcome.interrupted);
  Json json;
  json["schema"] = packing_schema;
  json["manifest_digest"] = outcome.spec.manifest_digest;
  json.update(to_json(outcome.jam.states[*nearest_state(outcome.jam)]));
  return json;
}

Json make_path(const Outcome& outcome) {
  assert(!outcome.failure && !outcome.interrupted);
  Json json;
  json["schema"] = path_schema;
  json["manifest_digest"] = outcome.spec.manifest_digest;
  json["states"] = Json::array();
  for (const auto& packing : outcome.jam.states) {
    Json state;
    put_distance(state, packing.density(), outcome.jam);
    state.update(to_json(packing));
    json["states"].push_back(std::move(state));
  }
  return json;
}

RecordSummary summarise_record(const Json& record, const std::string& file) {
  const JsonPlace root(record, file);
  root.at("schema").choice(std::array{record_schema});
  const auto spec = root.at("spec");
  RecordSummary summary;
  const auto solid = solid_kind(spec.at("solid").text());
  if (!solid) spec.at("solid").refuse("unknown solid");
  summary.solid = *solid;
  summary.particles = static_cast<int>(spec.at("particles").integer({1, 1e9}));
  summary.parameters = spec.at("parameters").value();
  spec.at("parameters").expect_object("an object");
  summary.replicate = static_cast<int>(spec.at("replicate").integer({0, 1e9}));
  summary.manifest_digest = root.at("provenance").at("manifest_digest").text();
  for (const std::string key : {"protocol", "minimiser", "measure", "modes"})
    summary.settings[key] = spec.at(key).value();
  summary.failed = root.at("status").choice(std::array<std::string_view, 2>{"done", "failed"}) == 1;
  if (summary.failed) {
    root.at("failure").at("where").text();
    root.at("failure").at("why").text();
  } else {
    read_values(root, summary);
    read_states(root.at("states"), summary);
    summary.flagged = root.at("flags").expect_list("a list of flags") > 0;
  }
  summary.result_digest = root.at("result_digest").text();
  summary.cpu_seconds = root.at("timing").at("cpu_seconds").number({0, 1e12});
  return summary;
}

}  // namespace isojam
