#include "engine/vibration/settle.hpp"

#include <utility>

#include "engine/packing/energy.hpp"
#include "engine/vibration/relax_to_minimum.hpp"

namespace isojam {

namespace {

/// Returns true if the state was a saddle and is now a minimum.
bool settle_state(Packing& packing, JamStep& step, const MinimumSearchOptions& options, const std::stop_token& stop) {
  MinimumSearchResult result = relax_to_minimum(packing, options, stop);
  if (result.ended != MinimumSearchEnd::reached_minimum) return false;
  packing = std::move(result.packing);
  const Evaluation value = PackingEnergy().evaluate(packing, result.summary.precision);
  step.energy_per_particle = value.energy / packing.size();
  step.pressure = value.pressure;
  step.density = packing.density();
  step.deviator = deviator_of(value);
  step.summary = result.summary;
  step.descents = result.descents;
  return true;
}

}  // namespace

void settle(JamResult& result, const JamOptions& options, std::stop_token stop) {
  MinimumSearchOptions search;
  search.minimise = options.minimise;
  search.modes.lowest = 4;  // one mode is used; the others improve the convergence of the Lanczos method
  bool changed = false;
  for (std::size_t k = 0; k < result.states.size() && !stop.stop_requested(); ++k) {
    if (result.states[k].size() == 0) continue;
    JamStep& step = result.path[static_cast<std::size_t>(result.state_steps[k])];
    // In a decompression under pressure control, the first state still has a given density.
    search.minimise.control = options.decompression.control == Control::pressure && k > 0
                                  ? control_at_pressure(options, step.pressure)
                                  : control_at_density(options);
    changed |= settle_state(result.states[k], step, search, stop);
  }
  if (changed) result.phi_j = fit_jamming_point(energy_points(result), options.decompression.fit_window);
}

}  // namespace isojam
