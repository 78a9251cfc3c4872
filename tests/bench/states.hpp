#pragma once

#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam::bench {

/// Random packings of density 0.7 after a few evaluations of L-BFGS each: contacts similar to those of a compressed
/// packing, at a cost that allows 10⁴ particles. Kept from one call to the next.
const std::vector<Packing>& relaxed(SolidKind kind, int n, int packings = 1);

/// A packing strained affinely from an equilibrium to `distance` in density above its jamming point, where it is not in
/// equilibrium. Kept from one call to the next.
const Packing& strained(SolidKind kind, int n, double distance);

}  // namespace isojam::bench
