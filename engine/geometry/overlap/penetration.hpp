#pragma once

#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// How far A and B reach into each other along an axis, and which: the shortest translation that parts them is `depth`
/// long and goes along it.
struct Penetration {
  SeparatingAxis axis;  ///< along which both are parted soonest
  Quad depth = 0;       ///< V_p^(1/3); negative if they are apart, and then no more than their distance
};

/// The axis of least depth among all face normals and edge-edge products, told apart in quadruple precision where
/// doubles cannot. Products of edges are tried in the direction from A to B, which is the right one unless the centres
/// nearly coincide. Slow: every axis is tried.
Penetration penetration(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);

}  // namespace isojam
