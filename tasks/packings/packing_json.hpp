#pragma once

#include "engine/packing/packing.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

/// A packing: the name of its solid, with vertices if it was defined by them, density, cell side, and per particle
/// position, quaternion (w, x, y, z) and the low parts of both (see Pose), without which a state near jamming would not
/// be an equilibrium to more than 1e-8 or so.
Json to_json(const Packing& packing);

/// Reads back a packing, bit for bit. Throws InputError for what is not one: lists of different lengths, a number that
/// is not finite, a quaternion that is zero, a cell too small for its solid.
Packing read_packing(const JsonPlace& place);

}  // namespace isojam
