#include "engine/solve/jam.hpp"

namespace isojam {

CellControl control_at_density(const JamOptions& options) {
  return {options.cell == CellShape::free ? CellFreedom::shape : CellFreedom::fixed, 0};
}

CellControl control_at_pressure(const JamOptions& options, double pressure) {
  return {options.cell == CellShape::free ? CellFreedom::free : CellFreedom::isotropic, pressure};
}

std::vector<EnergyPoint> energy_points(const JamResult& result) {
  std::vector<EnergyPoint> points;
  for (const int k : result.state_steps) {
    const JamStep& step = result.path[static_cast<std::size_t>(k)];
    points.push_back({step.density, step.energy_per_particle, step.pressure / (step.density * step.density)});
  }
  return points;
}

}  // namespace isojam
