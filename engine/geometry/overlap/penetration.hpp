#pragma once

#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// Penetration depth of A and B. The shortest translation that separates the two solids has the length `depth` and the
/// direction of `axis`.
struct Penetration {
  SeparatingAxis axis;  ///< axis with the smallest depth
  /// depth in units of V_p^(1/3). If the solids are separated, it is negative, and −depth is at most their distance
  Quad depth = 0;
};

/// Finds the axis with the smallest depth among all face normals and all vector products of two edges. If double
/// precision cannot decide between two axes, quadruple precision is used. The vector product of two edges can have two
/// directions. Only the direction from A to B is used, which is correct unless the centres nearly coincide. The
/// function is slow, because it computes the depth for every axis.
Penetration penetration(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);

}  // namespace isojam
