#include "tasks/records/restored.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/solve/jamming_point.hpp"
#include "tasks/packings/start_packing.hpp"

namespace isojam {

JamResult restored_jam(const Record& record, std::vector<Packing> states, const ReplicateSpec& spec,
                       const std::string& file) {
  const auto refuse = [&](std::string problem) { throw InputError({file, "/states", std::move(problem), "", ""}); };
  JamResult result;
  for (const auto& row : record.path) result.path.push_back(row.step);
  for (const auto& row : record.states) {
    if (static_cast<std::size_t>(row.index) >= record.path.size()) refuse("a state has no step in the path");
    result.state_steps.push_back(row.index);
  }
  if (record.states.size() != states.size())
    refuse(fmt::format("the record has {} states, but its path has {}", record.states.size(), states.size()));
  result.states = std::move(states);
  for (const auto& packing : result.states) {
    if (packing.size() == 0) continue;
    if (packing.size() != spec.particles || !are_particles_of(packing, spec.solid))
      refuse("the path contains packings of other particles");
  }
  const auto& flags = *record.flags.value;
  const bool early = std::find(flags.begin(), flags.end(), Flag::goal_not_reached) != flags.end();
  const bool as_given = spec.start && spec.start->stage == JamStage::as_given;
  result.status = as_given                              ? JamStatus::as_given
                  : ends_at_zero_pressure(spec.options) ? JamStatus::zero_pressure
                  : early                               ? JamStatus::goal_not_reached
                                                        : JamStatus::jammed;
  result.phi_j = fit_jamming_point(energy_points(result), spec.options.decompression.fit_window);
  for (const auto& cycle : record.cycles.value_or(std::vector<RecordedCycle>{}))
    result.cycles.push_back({cycle.energy_per_particle, cycle.phi_j.value, std::nullopt});
  result.evaluations = record.evaluations;
  result.counts = record.pairs;
  result.work = record.work;
  return result;
}

}  // namespace isojam
