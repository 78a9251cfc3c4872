// Jams 64 octahedra. Prints the jamming density, and the contact number of the state nearest to jamming.
#include <cstdio>
#include <exception>

#include "engine/geometry/convex_solid.hpp"
#include "engine/packing/energy.hpp"
#include "engine/solve/jam.hpp"

int main() try {
  // The same key gives the same packing, bit for bit.
  isojam::RandomStream random{2011};
  const auto& octahedron = isojam::platonic(isojam::SolidKind::octahedron);
  isojam::JamOptions options;
  options.decompression.final_distance = 0.01;
  const auto start = isojam::random_packing(octahedron, 64, options.compression.initial_density, random);
  const auto result = isojam::jam(start, options);
  if (!result.phi_j) {
    std::printf("not jammed: %s\n", isojam::to_string(result.status).data());
    return 1;
  }
  const isojam::Packing& nearest = result.states.back();
  const auto contacts = isojam::PackingEnergy().contacts(nearest);
  std::printf("phi_J = %.6f ± %.6f, Z = %.4f at phi - phi_J = %.4f\n", result.phi_j->density,
              result.phi_j->ci95_half_width, 2.0 * static_cast<double>(contacts.size()) / nearest.size(),
              nearest.density() - result.phi_j->density);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
