#pragma once

#include <cstdint>

#include "engine/solve/jam.hpp"

namespace isojam {

/// A solid and a number of particles.
struct System {
  SolidKind kind;
  int n;
};

/// Options for fast tests: large steps, and states that are far from jamming.
inline JamOptions lax() {
  JamOptions options;
  options.compression.initial_density = 0.2;
  options.compression.step = 0.03;
  options.decompression.step_fraction = 0.25;
  options.decompression.final_distance = 0.02;
  options.decompression.longest_step = 0.025;
  options.decompression.fit_window = 0.06;
  options.compression.evaluations = 200;
  options.minimise.residual = 1e-5;
  options.minimise.max_evaluations = 2000;
  return options;
}

inline Packing start_of(const System& system, std::uint64_t seed, const JamOptions& options) {
  RandomStream random{seed};
  return random_packing(platonic(system.kind), system.n, options.compression.initial_density, random);
}

inline const System small{SolidKind::dodecahedron, 24};

}  // namespace isojam
