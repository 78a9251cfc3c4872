#pragma once

#include "engine/packing/packing.hpp"

namespace isojam {

/// The energy from all images of all pairs, including images of the same particle, by clipping in quadruple precision.
/// It is correct for any cell.
double energy_over_images(const Packing& packing);
/// The energy from only the nearest image of each pair.
double energy_of_nearest_images(const Packing& packing);

/// A packing of n tetrahedra at random positions near the corner of a cell. They are so close that all of them touch,
/// most of them across a periodic boundary.
Packing cornered(int n, double side);

/// A packing of twelve solids near the origin of a cell. The cell is so large that no rotation of the packing makes a
/// solid touch an image.
Packing cluster(SolidKind kind);

}  // namespace isojam
