#pragma once

#include "engine/packing/packing.hpp"

namespace isojam {

/// The energy of all pairs of particles and images, including pairs of a particle and its own image, by clipping in
/// quadruple precision. It is correct for every cell in the atlas, however small.
double energy_over_images(const Packing& packing);
/// The energy of all pairs of particles, with only the nearest image of each pair.
double energy_of_nearest_images(const Packing& packing);

/// A packing of n tetrahedra at random positions near the corner of a cell. They are so close together that all of them
/// touch, most of them across a face of the cell.
Packing cornered(int n, double side);

/// A packing of twelve solids near the origin of a cell. The cell is so large that, for every rotation of the packing,
/// no solid touches an image.
Packing cluster(SolidKind kind);

}  // namespace isojam
