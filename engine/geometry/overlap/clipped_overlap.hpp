#pragma once

#include <cstdint>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// An Overlap in quadruple precision: V in V_p, S_A and M_A in V_p^(2/3) and V_p, in A's body frame.
struct QuadOverlap {
  Quad volume = 0;
  Quad3 area{}, moment{};
  std::uint64_t faces_a = 0, faces_b = 0;
  std::uint64_t edges_a = 0, edges_b = 0;
};

/// The nearest doubles; its path is OverlapPath::clip unless the volume is 0.
Overlap narrowed(const QuadOverlap& exact);

/// The slow path of overlap() and its oracle: A cut by the face planes of B one after another in quadruple precision,
/// V, S_A and M_A by the divergence theorem over what is left, in A's body frame.
QuadOverlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);
Overlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

}  // namespace isojam
