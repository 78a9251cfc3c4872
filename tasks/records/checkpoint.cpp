#include "tasks/records/checkpoint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tasks/packings/packing_json.hpp"
#include "tasks/packings/start_packing.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/texts.hpp"
#include "tasks/records/work_json.hpp"

namespace isojam {
namespace {

/// If no contact carries a force, the residual is infinite. JSON has no infinity, so null is written.
Json residual_json(double residual) { return std::isinf(residual) ? Json(nullptr) : Json(residual); }
double read_residual(const JsonPlace& place) {
  return place.value().is_null() ? std::numeric_limits<double>::infinity() : place.number(not_negative);
}

Json step_json(const JamStep& step) {
  const auto& summary = step.summary;
  Json json;
  json["stage"] = to_string(step.stage);
  json["density"] = step.density;
  json["energy_per_particle"] = step.energy_per_particle;
  json["pressure"] = step.pressure;
  json["deviator"] = step.deviator;
  json["descents"] = step.descents;
  if (step.rearrangement) json["rearrangement"] = to_json(*step.rearrangement);
  if (step.lost) json["lost"] = true;
  json["stopped"] = to_string(summary.reason);
  json["energy"] = summary.energy;
  json["residual"] = residual_json(summary.residual);
  json["residual_floor"] = residual_json(summary.residual_floor);
  json["double_double"] = summary.precision == Precision::double_double;
  json["evaluations"] = summary.evaluations;
  json["iterations"] = summary.iterations;
  json["work"] = to_json(summary.work);
  return json;
}

JamStep read_step(const JsonPlace& place) {
  JamStep step;
  step.stage = place.at("stage").choice<JamStage>();
  step.density = place.at("density").number(not_negative);
  step.energy_per_particle = place.at("energy_per_particle").number(any_number);
  step.pressure = place.at("pressure").number(any_number);
  step.deviator = place.at("deviator").number(not_negative);
  step.descents = static_cast<int>(place.at("descents").integer({0, 1e9}));
  if (place.has("rearrangement")) step.rearrangement = read_rearrangement(place.at("rearrangement"));
  step.lost = place.has("lost") && place.at("lost").boolean();
  auto& summary = step.summary;
  summary.reason = place.at("stopped").choice<StopReason>();
  summary.energy = place.at("energy").number(any_number);
  summary.residual = read_residual(place.at("residual"));
  summary.residual_floor = read_residual(place.at("residual_floor"));
  summary.precision = place.at("double_double").boolean() ? Precision::double_double : Precision::working;
  summary.evaluations = place.at("evaluations").integer(count_range);
  summary.iterations = place.at("iterations").integer(count_range);
  summary.work = read_work(place.at("work"));
  return step;
}

Json cycle_json(const Cycle& cycle) {
  Json json;
  json["energy_per_particle"] = cycle.energy_per_particle;
  if (cycle.phi_j) json["phi_j"] = *cycle.phi_j;
  if (cycle.nearest) json["nearest"] = to_json(*cycle.nearest);
  return json;
}

bool is_finite(const JamStep& step) {
  const auto& summary = step.summary;
  return std::isfinite(step.density) && std::isfinite(step.energy_per_particle) && std::isfinite(step.pressure) &&
         std::isfinite(step.deviator) && std::isfinite(summary.energy) && !std::isnan(summary.residual) &&
         !std::isnan(summary.residual_floor);
}

Packing read_own_packing(const JsonPlace& place, const ReplicateSpec& spec) {
  auto packing = read_packing(place);
  if (packing.size() != spec.particles || !are_particles_of(packing, spec.solid))
    place.refuse("the packing does not belong to this replicate",
                 fmt::format("{} particles of {}", spec.particles, to_string(spec.solid)));
  return packing;
}

void read_states(const JsonPlace& root, const ReplicateSpec& spec, JamResult& result) {
  const auto states = root.at("states"), steps = root.at("state_steps");
  const auto count = states.expect_list("a list of packings");
  steps.expect_length(count, "one step for each state");
  const auto last = static_cast<double>(result.path.size()) - 1;
  for (std::size_t k = 0; k < count; ++k) {
    result.states.push_back(read_own_packing(states.at(k), spec));
    result.state_steps.push_back(static_cast<int>(steps.at(k).integer({0, last})));
  }
}

Cycle read_cycle(const JsonPlace& place, const ReplicateSpec& spec) {
  Cycle cycle;
  cycle.energy_per_particle = place.at("energy_per_particle").number(any_number);
  if (place.has("phi_j")) cycle.phi_j = place.at("phi_j").number(any_number);
  if (place.has("nearest")) cycle.nearest = read_own_packing(place.at("nearest"), spec);
  return cycle;
}

JamResult read_result(const JsonPlace& root, const ReplicateSpec& spec) {
  JamResult result;
  result.status = root.at("status").choice<JamStatus>();
  result.evaluations = root.at("evaluations").integer(count_range);
  result.counts = read_counts(root.at("pairs"));
  result.work = read_work(root.at("work"));
  const auto path = root.at("path");
  const auto steps = path.expect_list(list_of_steps);
  if (steps == 0) path.refuse("the list is empty", "one or more steps");
  for (std::size_t k = 0; k < steps; ++k) result.path.push_back(read_step(path.at(k)));
  read_states(root, spec, result);
  if (root.has("cycles")) {
    const auto cycles = root.at("cycles");
    const auto count = cycles.expect_list("a list of cycles");
    for (std::size_t k = 0; k < count; ++k) result.cycles.push_back(read_cycle(cycles.at(k), spec));
  }
  if (result.status != JamStatus::not_called)
    result.phi_j = fit_jamming_point(energy_points(result), spec.options.decompression.fit_window);
  return result;
}

/// Index of a step in the path, or −1 if no solution branch was lost.
int read_lost_branch(const JsonPlace& root) {
  const auto steps = static_cast<double>(root.at("path").expect_list(list_of_steps));
  return static_cast<int>(root.at("lost").integer({-1, steps - 1}));
}

/// Build and manifest of the checkpoint. The digest excludes measures, because measures may be added while a run is
/// interrupted.
Json origin(const ReplicateSpec& spec) {
  auto json = provenance(spec);
  json["manifest_digest"] = spec.sweep_digest;
  return json;
}
Json run_of(const ReplicateSpec& spec) {
  auto json = to_json(spec);
  json.erase("measure");
  return json;
}

Json to_json(const ProcessId& process) {
  return {{"machine", process.machine}, {"process", process.process}, {"started", process.started}};
}

}  // namespace

std::optional<Json> make_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) {
  const auto& progress = checkpoint.progress;
  const auto& result = progress.result;
  if (!std::all_of(result.path.begin(), result.path.end(), is_finite)) return std::nullopt;
  Json json;
  json["schema"] = checkpoint_schema;
  json["provenance"] = origin(spec);
  json["spec"] = run_of(spec);
  json["writer"] = to_json(this_process());
  json["timing"] = to_json(checkpoint.spent);
  json["status"] = to_string(result.status);
  json["stage"] = to_string(progress.stage);
  json["step_fraction"] = progress.step_fraction;
  json["halvings"] = progress.halvings;
  json["lost"] = progress.lost;
  json["evaluations"] = result.evaluations;
  json["pairs"] = to_json(result.counts);
  json["work"] = to_json(result.work);
  json["path"] = Json::array();
  for (const auto& step : result.path) json["path"].push_back(step_json(step));
  json["state_steps"] = result.state_steps;
  json["states"] = Json::array();
  for (const auto& state : result.states) json["states"].push_back(to_json(state));
  for (const auto& cycle : result.cycles) json["cycles"].push_back(cycle_json(cycle));
  json["packing"] = to_json(progress.packing);
  return json;
}

ProcessId read_writer(const JsonPlace& root) {
  const auto writer = root.at("writer");
  return {writer.at("machine").text(), writer.at("process").integer(count_range),
          writer.at("started").integer(count_range)};
}

Checkpoint read_checkpoint(const JsonPlace& root, const ReplicateSpec& spec) {
  root.at("schema").choice(std::array{checkpoint_schema});
  if (root.at("provenance").value() != origin(spec))
    root.at("provenance").refuse("the checkpoint belongs to another manifest or another build of isojam");
  if (root.at("spec").value() != run_of(spec)) root.at("spec").refuse("the checkpoint belongs to another replicate");
  read_writer(root);
  const auto timing = root.at("timing");
  return {{read_own_packing(root.at("packing"), spec), root.at("stage").choice<JamStage>(),
           root.at("step_fraction").number({0, 1, true}), static_cast<int>(root.at("halvings").integer({0, 100})),
           read_lost_branch(root), read_result(root, spec)},
          {timing.at("wall_seconds").number(not_negative), timing.at("cpu_seconds").number(not_negative)}};
}

}  // namespace isojam
