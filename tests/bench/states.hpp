#pragma once

#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam::bench {

/// Random packings with density 0.7 after a few evaluations with L-BFGS. Their contacts are similar to those of a
/// compressed packing, but such packings can be computed even for 10⁴ particles. Later calls with the same arguments
/// return the same object.
const std::vector<Packing>& relaxed(SolidKind kind, int n, int packings = 1);

/// A packing whose density is about φ_J + `distance`. It was strained from an equilibrium and is not in equilibrium
/// itself. Later calls with the same arguments return the same object.
const Packing& strained(SolidKind kind, int n, double distance);

}  // namespace isojam::bench
