#include "tasks/measure/measure.hpp"

#include <cassert>

#include "tasks/measure/parts.hpp"

namespace isojam {

std::string_view to_string(Measure measure) {
  static constexpr std::array<std::string_view, all_measures.size()> names{"contacts", "order",  "clusters",
                                                                           "modes",    "moduli", "rigidity"};
  return names[static_cast<std::size_t>(measure)];
}

Measurement measure(Measure what, const JamResult& jam, const MeasureOptions& options) {
  switch (what) {
    case Measure::contacts: return measure_contacts(jam);
    case Measure::order: return measure_order(jam);
    case Measure::clusters: return measure_clusters(jam);
    case Measure::modes: return measure_modes(jam, options.modes);
    case Measure::moduli: return measure_moduli(jam);
    case Measure::rigidity: return measure_rigidity(jam);
  }
  assert(false);
  return {};
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
