#include "tasks/extras/chart/atlas/states.hpp"

#include <stdexcept>

#include "engine/random/stream.hpp"
#include "engine/solve/jam.hpp"

namespace isojam {

AtlasStates::AtlasStates(const std::stop_token& stop) {
  JamOptions options;
  options.compression.initial_density = 0.2;
  options.decompression.final_distance = 1.3e-3;
  options.compression.evaluations = 500;  // less than the default, because the compression is not examined here
  options.minimise.residual = 1e-9;
  RandomStream random{1, static_cast<std::uint64_t>(SolidKind::octahedron)};
  const ConvexSolid& solid = platonic(SolidKind::octahedron);
  const int particles = least_particles(solid, options.compression.max_density);
  JamResult result = jam(random_packing(solid, particles, options.compression.initial_density, random), options, stop);
  if (stop.stop_requested()) return;
  if (!result.phi_j || result.states.empty()) throw std::runtime_error("the octahedra of the atlas did not jam");
  phi_j_ = result.phi_j->density;
  states_ = std::move(result.states);
}

const Packing& AtlasStates::above(double delta_phi) const {
  // The states are in the order of decompression. The last one with a larger distance is the nearest.
  const Packing* nearest = &states_.front();
  for (const Packing& state : states_) {
    if (distance_of(state) > delta_phi) nearest = &state;
  }
  return *nearest;
}

}  // namespace isojam
