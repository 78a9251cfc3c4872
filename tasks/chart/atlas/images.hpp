#pragma once

#include "engine/packing/packing.hpp"

namespace isojam {

/// E from every image of every pair, self-images too, by the clip in quadruple precision: true in any cell.
double energy_over_images(const Packing& packing);
/// The energy from the nearest image of each pair alone.
double energy_of_nearest_images(const Packing& packing);

/// n tetrahedra at random about the corner of a cell, so near each other that all touch, most across a boundary.
Packing cornered(int n, double side);

/// Twelve solids near the origin of a cell so wide that they stay clear of their images however they are turned.
Packing cluster(SolidKind kind);

}  // namespace isojam
