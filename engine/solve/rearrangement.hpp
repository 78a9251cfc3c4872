#pragma once

#include "engine/solve/jam.hpp"

namespace isojam {

/// Estimated φ − φ_J of a minimised state, from E ∝ (φ − φ_J)⁶: 6E/(dE/dφ), dE/dφ = N p/φ².
double distance_to_jamming(const JamStep& step);

/// How the equilibrium `after` differs from `before`, in packings of the same particles at two densities.
Rearrangement rearrangement(const Packing& before, const JamStep& step_before, const Packing& after,
                            const JamStep& step_after);

}  // namespace isojam
