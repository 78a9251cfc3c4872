#pragma once

#include "engine/packing/energy.hpp"
#include "engine/solve/jam.hpp"

namespace isojam::test {

/// A result with one state, the packing as it is.
inline JamResult single_state(const Packing& packing) {
  const Evaluation here = PackingEnergy().evaluate(packing);
  JamResult result;
  JamStep step;
  step.stage = JamStage::decompression;
  step.density = packing.density();
  step.energy_per_particle = here.energy / packing.size();
  step.pressure = here.pressure;
  step.summary.reason = StopReason::residual_reached;
  result.path = {step};
  result.states = {packing};
  result.state_steps = {0};
  result.status = JamStatus::not_jammed;
  return result;
}

/// As few octahedra as their cell allows, decompressed to Δφ = 0.01.
inline JamResult jammed_octahedra(double residual) {
  RandomStream random{17};
  JamOptions options;
  options.compression.step = 0.05;
  options.decompression.final_distance = 0.01;
  options.minimise.residual = residual;
  const ConvexSolid& solid = platonic(SolidKind::octahedron);
  return jam(random_packing(solid, least_particles(solid, options.compression.max_density), 0.2, random), options);
}

}  // namespace isojam::test
