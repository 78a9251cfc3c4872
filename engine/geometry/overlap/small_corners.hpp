#pragma once

#include "engine/geometry/overlap/contact_loop.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Takes the corners of a closed loop again in double-double, if the contact is so small, or so slender, that the
/// rounding of corners would spoil its vector area `area`: by more than some 1e-13. They are then counted from one of
/// them, loop.origin, as their heights are, each right to its last bits. True if they were. Both solids are placed in
/// double-double.
bool refine_small_corners(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                          const Eigen::Vector3d& area, ContactLoop& loop);

}  // namespace isojam
