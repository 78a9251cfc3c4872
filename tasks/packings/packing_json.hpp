#pragma once

#include "engine/packing/packing.hpp"
#include "tasks/io/place.hpp"

namespace isojam {

/// Largest number of particles of a packing that can be read.
inline constexpr std::size_t most_particles = 1000000;

/// Converts a packing to JSON: its solids and sizes, the density, the cell, and the position and the quaternion (w, x,
/// y, z) of each particle. Each coordinate is stored in double-double; with only the first doubles, a state near
/// jamming would have a residual of about 1e-8.
Json to_json(const Packing& packing);

/// Reads a packing with all bits of the original. Throws InputError if lists have different lengths, if a number is not
/// allowed, if the squared length of a quaternion is at most 0.5, or if a particle could touch two images of another
/// one in the cell.
Packing read_packing(const JsonPlace& place);

}  // namespace isojam
