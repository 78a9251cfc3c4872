#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// An Overlap in quadruple precision: V in V_p, S_A in V_p^(2/3) and M_A in V_p, in A's body frame.
struct QuadOverlap {
  Quad volume = 0;                         ///< V
  Quad3 area{}, moment{};                  ///< S_A and M_A
  std::uint64_t faces_a = 0, faces_b = 0;  ///< bits of the faces that bound the intersection
  std::uint64_t edges_a = 0, edges_b = 0;  ///< bits of the edges with a segment inside the other solid
};

/// A ∩ B in quadruple precision: a convex polyhedron in A's body frame.
struct QuadIntersection {
  /// A polygon on a face of A or of B, counter-clockwise seen from outside.
  struct Polygon {
    std::vector<int> loop;  ///< indices of points
    int face = 0;           ///< index of the face of A or of B
    bool of_a = true;       ///< true for a face of A, false for one of B
  };
  std::vector<Quad3> points;   ///< vertices of the polygons, and unused points that were cut away
  std::vector<Polygon> faces;  ///< all polygons that bound the intersection
};

/// The intersection of A and B: A is cut by the face planes of B one after another. The result is empty for separated
/// solids, and flat for solids that touch without a common volume.
QuadIntersection clipped_intersection(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);

/// V, S_A and M_A of an intersection of A and B by the divergence theorem, and the faces and edges that bound it.
QuadOverlap overlap_of(const ConvexSolid& a, const ConvexSolid& b, const QuadIntersection& intersection);

/// Rounds to the nearest doubles. The path is OverlapPath::clip unless the volume is 0.
Overlap narrowed(const QuadOverlap& exact);

/// The slow path of overlap(), and its test oracle: overlap_of() applied to clipped_intersection().
QuadOverlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);
Overlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

}  // namespace isojam
