#include "tasks/measure/measure.hpp"

#include <cassert>

namespace isojam {

Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options) {
  return definition_of(what).measure(jam, options);
}

std::optional<std::size_t> nearest_state(const JamResult& jam) {
  assert(jam.states.size() == jam.state_steps.size());
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < jam.states.size(); ++i) {
    if (jam.path[jam.state_steps[i]].energy_per_particle <= 0) continue;
    if (!nearest || jam.states[i].density() < jam.states[*nearest].density()) nearest = i;
  }
  return nearest;
}

}  // namespace isojam
