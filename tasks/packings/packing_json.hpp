#pragma once

#include "engine/packing/packing.hpp"
#include "tasks/io/place.hpp"

namespace isojam {

/// Largest number of particles of a packing that can be read.
inline constexpr std::size_t most_particles = 1000000;

/// A packing as JSON: the name of its solid, with the vertices if it is user-defined, the density, the side of the
/// cell, and for each particle the position and the quaternion (w, x, y, z). Both are stored as two doubles, see Pose.
/// With only the first doubles, a state near jamming would have a residual of about 1e-8.
Json to_json(const Packing& packing);

/// Reads a packing with all bits of the original. Throws InputError if lists have different lengths, if a number is not
/// finite, if a quaternion is zero, or if the cell is so small that a particle could touch two images of another one.
Packing read_packing(const JsonPlace& place);

}  // namespace isojam
