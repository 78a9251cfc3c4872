#include "tasks/measure/measure.hpp"

#include <cassert>
#include <utility>

namespace isojam {

Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options) {
  return definition_of(what).measure(jam, options);
}

Measurement measure_nearest(Measure what, const JamResult& jam, const MeasureOptions& options) {
  const auto nearest = nearest_state(jam);
  assert(nearest);
  JamResult alone = jam;
  alone.states = {jam.states[*nearest]};
  alone.state_steps = {jam.state_steps[*nearest]};
  auto measurement = measure(what, alone, options);
  std::vector<Json> states(jam.states.size(), Json::object());
  states[*nearest] = std::move(measurement.states.front());
  measurement.states = std::move(states);
  measurement.nearest_only = true;
  return measurement;
}

std::optional<std::size_t> nearest_state(const JamResult& jam) {
  assert(jam.states.size() == jam.state_steps.size());
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < jam.states.size(); ++i) {
    const auto& step = jam.path[jam.state_steps[i]];
    if (jam.states[i].size() == 0 || (step.energy_per_particle == 0 && step.stage != JamStage::as_given)) continue;
    if (!nearest || jam.states[i].density() < jam.states[*nearest].density()) nearest = i;
  }
  return nearest;
}

}  // namespace isojam
