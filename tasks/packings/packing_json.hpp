#pragma once

#include "engine/packing/packing.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

/// A packing: name of its solid, with vertices if it was defined by them, density, cell side, and for each particle
/// position, quaternion (w, x, y, z) and the low parts of both (see Pose). Without the low parts a state near jamming
/// would be an equilibrium only to about 1e-8.
Json to_json(const Packing& packing);

/// Reads a packing back bit for bit. Throws InputError for lists of different lengths, a number that is not finite, a
/// zero quaternion, and a cell too small for its solid.
Packing read_packing(const JsonPlace& place);

}  // namespace isojam
