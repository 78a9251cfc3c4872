#pragma once

#include <cstdint>

#include "engine/solve/jam.hpp"

namespace isojam {

struct System {
  SolidKind kind;
  int n;
};

/// Large steps and a coarse goal.
inline JamOptions lax() {
  JamOptions options;
  options.initial_density = 0.2;
  options.consolidation_step = 0.03;
  options.step_fraction = 0.25;
  options.final_distance = 0.02;
  options.longest_step = 0.025;
  options.fit_window = 0.06;
  options.consolidation_evaluations = 200;
  options.minimise.residual = 1e-5;
  options.minimise.max_evaluations = 2000;
  return options;
}

inline Packing start_of(const System& system, std::uint64_t seed, const JamOptions& options) {
  RandomStream random{seed};
  return random_packing(platonic(system.kind), system.n, options.initial_density, random);
}

inline const System small{SolidKind::dodecahedron, 24};

}  // namespace isojam
