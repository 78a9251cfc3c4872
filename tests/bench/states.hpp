#pragma once

#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam::bench {

/// Random packings of density .7 after a few evaluations of L-BFGS each: contacts as a compressed packing has them, at
/// a cost that allows 10⁴ particles. Kept from one call to the next.
const std::vector<Packing>& relaxed(SolidKind kind, int n, int packings = 1);

/// An equilibrium above jamming, reached from density .78 by strain steps. Kept from one call to the next.
const Packing& equilibrium(SolidKind kind, int n, double density);

}  // namespace isojam::bench
