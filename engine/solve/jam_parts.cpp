#include <algorithm>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/packing/energy.hpp"
#include "engine/solve/jam.hpp"
#include "engine/solve/rearrangement.hpp"

namespace isojam {

bool ends_at_zero_pressure(const JamOptions& options) {
  return options.cohesion.acts() && options.cohesion_until == CohesionUntil::end;
}

CellControl control_at_density(const JamOptions& options) {
  return {options.cell == CellShape::free ? CellFreedom::shape : CellFreedom::fixed, 0};
}

CellControl control_at_pressure(const JamOptions& options, double pressure) {
  return {options.cell == CellShape::free ? CellFreedom::free : CellFreedom::isotropic, pressure};
}

double aimed_strain(const Compression& compression, const JamStep& last) {
  if (!(last.energy_per_particle > 0)) return compression.step;
  const double growth = nearest::pow(compression.target_energy / last.energy_per_particle, 1.0 / 6);
  // Slightly farther, because the last state is not quite relaxed.
  return std::clamp(1.2 * distance_to_jamming(last) * (growth - 1), compression.step / 4, compression.step);
}

std::vector<EnergyPoint> energy_points(const JamResult& result) {
  std::vector<EnergyPoint> points;
  for (const int k : result.state_steps) {
    const JamStep& step = result.path[static_cast<std::size_t>(k)];
    points.push_back({step.density, step.energy_per_particle, step.pressure / (step.density * step.density)});
  }
  return points;
}

Cycle cycle_of(const JamResult& result, double fit_window) {
  Cycle cycle;
  if (!result.states.empty()) {
    cycle.energy_per_particle = result.path[static_cast<std::size_t>(result.state_steps.front())].energy_per_particle;
    cycle.nearest = result.states.back();
  }
  if (const auto point = fit_jamming_point(energy_points(result), fit_window)) cycle.phi_j = point->density;
  return cycle;
}

JamProgress begin_as_given(Packing packing) {
  PackingEnergy energy;
  JamProgress progress{packing, JamStage::as_given, 0, 0, -1, {}};
  JamResult& result = progress.result;
  JamStep& step = result.path.emplace_back();
  const Evaluation value = energy.evaluate(packing, Precision::double_double);
  step.stage = JamStage::as_given;
  step.density = packing.density();
  step.energy_per_particle = value.energy / packing.size();
  step.pressure = value.pressure;
  step.deviator = deviator_of(value);
  step.summary.residual = value.residual;
  step.summary.precision = Precision::double_double;
  result.states.push_back(std::move(packing));
  result.state_steps.push_back(0);
  result.evaluations = energy.evaluations();
  result.counts = energy.counts();
  result.status = JamStatus::as_given;
  return progress;
}

}  // namespace isojam
