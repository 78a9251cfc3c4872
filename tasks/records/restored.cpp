#include "tasks/records/restored.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "tasks/packings/start_packing.hpp"
#include "tasks/records/texts.hpp"
#include "tasks/records/work_json.hpp"

namespace isojam {
namespace {

/// Reads a number that put_number() wrote.
double read_number(const JsonPlace& object, const std::string& key) {
  const auto place = object.at(key);
  if (!place.value().is_null()) return place.number(any_number);
  const auto reason = object.at(key + "_reason").choice(std::array<std::string_view, 2>{"infinite", "not a number"});
  return reason == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

long read_count(const JsonPlace& object, const std::string& key) {
  return static_cast<long>(object.at(key).integer(count_range));
}

JamStep read_recorded_step(const JsonPlace& place) {
  JamStep step;
  step.stage = place.at("stage").choice<JamStage>();
  step.density = read_number(place, "phi");
  step.energy_per_particle = read_number(place, "energy_per_particle");
  step.pressure = read_number(place, "pressure");
  step.deviator = read_number(place, "deviator");
  step.summary.residual = read_number(place, "residual");
  step.summary.residual_floor = read_number(place, "residual_floor");
  step.summary.reason = place.at("stopped").choice<StopReason>();
  step.summary.evaluations = read_count(place, "evaluations");
  step.summary.iterations = read_count(place, "iterations");
  step.descents = static_cast<int>(read_count(place, "descents"));
  if (place.has("rearrangement")) step.rearrangement = read_rearrangement(place.at("rearrangement"));
  step.lost = place.has("lost") && place.at("lost").boolean();
  return step;
}

std::vector<int> read_state_steps(const JsonPlace& states, std::size_t steps) {
  std::vector<int> list;
  const auto count = states.expect_list(list_of_states);
  for (std::size_t k = 0; k < count; ++k)
    list.push_back(static_cast<int>(states.at(k).at("step").integer({0, static_cast<double>(steps) - 1})));
  return list;
}

bool has_flag(const JsonPlace& record, Flag flag) {
  const auto& flags = record.at("flags").value();
  return std::find(flags.begin(), flags.end(), to_string(flag)) != flags.end();
}

}  // namespace

JamResult restored_jam(const JsonPlace& record, std::vector<Packing> states, const ReplicateSpec& spec) {
  JamResult result;
  const auto path = record.at("path");
  const auto steps = path.expect_list(list_of_steps);
  for (std::size_t k = 0; k < steps; ++k) result.path.push_back(read_recorded_step(path.at(k)));
  result.state_steps = read_state_steps(record.at("states"), steps);
  if (result.state_steps.size() != states.size())
    record.at("states").refuse(
        fmt::format("the record has {} states, but its path has {}", result.state_steps.size(), states.size()));
  result.states = std::move(states);
  for (const auto& packing : result.states) {
    if (packing.size() == 0) continue;
    if (packing.size() != spec.particles || !are_particles_of(packing, spec.solid))
      record.at("states").refuse("the path contains packings of other particles");
  }
  result.status = ends_at_zero_pressure(spec.options)        ? JamStatus::zero_pressure
                  : has_flag(record, Flag::goal_not_reached) ? JamStatus::goal_not_reached
                                                             : JamStatus::jammed;
  result.phi_j = fit_jamming_point(energy_points(result), spec.options.decompression.fit_window);
  if (record.has("cycles")) {
    const auto cycles = record.at("cycles");
    const auto count = cycles.expect_list("a list of cycles");
    for (std::size_t k = 0; k < count; ++k) {
      const auto cycle = cycles.at(k);
      const bool has_point = !cycle.at("phi_j").value().is_null();
      result.cycles.push_back({read_number(cycle, "energy_per_particle"),
                               has_point ? std::optional(read_number(cycle, "phi_j")) : std::nullopt, std::nullopt});
    }
  }
  result.evaluations = read_count(record, "evaluations");
  result.counts = read_counts(record.at("pairs"));
  result.work = read_work(record.at("work"));
  return result;
}

}  // namespace isojam
