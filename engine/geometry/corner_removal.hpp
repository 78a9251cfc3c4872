#pragma once

#include <vector>

#include "engine/geometry/hull_triangles.hpp"

namespace isojam {

/// Removes corners of a triangulated hull until `corners` ≥ 4 of them are left. Every corner of a triangle must be a
/// corner of the hull, not a point on a face or an edge. The next corner to remove is the one
/// whose removal reduces the volume least. The result is the convex hull of the remaining corners. The time is
/// O(n log n) for n corners if few triangles meet at each corner.
std::vector<HullTriangle> without_smallest_corners(const HullPoints& points, const std::vector<HullTriangle>& triangles,
                                                   int corners);

}  // namespace isojam
