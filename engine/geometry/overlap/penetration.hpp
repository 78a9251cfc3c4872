#pragma once

#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// Penetration depth of A and B, and its axis: the shortest translation that separates them has length `depth` and this
/// direction.
struct Penetration {
  SeparatingAxis axis;  ///< axis with the smallest depth
  Quad depth = 0;  ///< V_p^(1/3); negative if the solids are separated, and then −depth is at most their distance
};

/// The axis with the smallest depth among all face normals and edge-edge products. Quadruple precision decides where
/// doubles cannot. Products of edges are tried in the direction from A to B, which is correct unless the centres nearly
/// coincide. Slow: it tries every axis.
Penetration penetration(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);

}  // namespace isojam
