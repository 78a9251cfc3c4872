#pragma once

#include "engine/geometry/overlap/contact_loop.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Recomputes the corners of a closed loop in double-double if the contact is very small or narrow. The criterion is
/// whether rounding errors of the corners would change the vector area `area` by more than about 1e-13 of its length.
/// Corners and heights are then stored relative to one of the corners, loop.origin, and are correct to their last bits.
/// Returns true if the corners were recomputed. Both solids must have been placed in double-double.
template <class Solids>
bool refine_small_corners(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                          const Eigen::Vector3d& area, ContactLoop<Solids>& loop);

}  // namespace isojam
