#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// An Overlap in quadruple precision: V in V_p, S_A and M_A in V_p^(2/3) and V_p, in A's body frame.
struct QuadOverlap {
  Quad volume = 0;                         ///< V
  Quad3 area{}, moment{};                  ///< S_A and M_A
  std::uint64_t faces_a = 0, faces_b = 0;  ///< bits of the faces that bound the intersection
  std::uint64_t edges_a = 0, edges_b = 0;  ///< bits of the edges with a segment inside the other
};

/// A ∩ B in quadruple precision: a convex polyhedron in A's body frame.
struct QuadIntersection {
  /// A polygon on face `face` of A or of B, counter-clockwise seen from outside.
  struct Polygon {
    std::vector<int> loop;  ///< indices of points
    int face = 0;           ///< of A or of B, by number
    bool of_a = true;       ///< which of both
  };
  std::vector<Quad3> points;   ///< the polygons', and others that were cut away
  std::vector<Polygon> faces;  ///< all that bound it
};

/// A cut by the face planes of B one after another. Nothing is left of solids that are apart, and what is left of those
/// that touch without a volume is flat.
QuadIntersection clipped_intersection(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);

/// V, S_A and M_A by the divergence theorem over an intersection of A and B, and what of either bounds it.
QuadOverlap overlap_of(const ConvexSolid& a, const ConvexSolid& b, const QuadIntersection& intersection);

/// The nearest doubles; its path is OverlapPath::clip unless the volume is 0.
Overlap narrowed(const QuadOverlap& exact);

/// The slow path of overlap() and its oracle: overlap_of() the clipped_intersection().
QuadOverlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);
Overlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

}  // namespace isojam
