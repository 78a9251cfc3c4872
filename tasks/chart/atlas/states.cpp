#include "tasks/chart/atlas/states.hpp"

namespace isojam {

namespace {

JamResult made() {
  JamOptions options;
  options.initial_density = 0.2;
  options.final_distance = 1.3e-3;
  options.minimise.residual = 1e-9;
  RandomStream random{1, static_cast<std::uint64_t>(SolidKind::octahedron)};
  const ConvexSolid& solid = platonic(SolidKind::octahedron);
  const int particles = least_particles(solid, options.max_density);
  return jam(random_packing(solid, particles, options.initial_density, random), options);
}

}  // namespace

const JamResult& atlas_states() {
  static const JamResult result = made();
  return result;
}

double distance_of(const Packing& packing) { return packing.density() - atlas_states().phi_j->density; }

const Packing& state_above(double delta_phi) {
  // In the order of expansion: the last that lies above is the nearest.
  const Packing* nearest = &atlas_states().states.front();
  for (const Packing& state : atlas_states().states) {
    if (distance_of(state) > delta_phi) nearest = &state;
  }
  return *nearest;
}

}  // namespace isojam
