#pragma once

#include "engine/solve/jam.hpp"

namespace isojam {

/// 45 octahedra, the fewest that fit a legal cell, expanded to Δφ = 1.3e-3: condition numbers from 1e3 to 7e11. Made
/// once per program.
const JamResult& atlas_states();

/// φ − φ_J of a state of it.
double distance_of(const Packing& packing);

/// The state of it from which one strain step leads to Δφ: the nearest of those above.
const Packing& state_above(double delta_phi);

}  // namespace isojam
