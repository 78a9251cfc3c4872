#pragma once

#include "engine/packing/packing.hpp"

namespace isojam {

/// E from every image of every pair, including self-images, by the clip in quadruple precision. Correct in any cell.
double energy_over_images(const Packing& packing);
/// The energy from only the nearest image of each pair.
double energy_of_nearest_images(const Packing& packing);

/// n tetrahedra at random about the corner of a cell, so close that all touch, most of them across a boundary.
Packing cornered(int n, double side);

/// Twelve solids near the origin of a cell so wide that no rotation brings them in contact with their images.
Packing cluster(SolidKind kind);

}  // namespace isojam
