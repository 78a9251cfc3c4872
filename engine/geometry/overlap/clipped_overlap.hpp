#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// An Overlap in quadruple precision. Vectors are in the body frame of A; the units are those of Overlap.
struct QuadOverlap {
  Quad volume = 0;                  ///< V
  Quad3 area{}, moment{};           ///< S_A and M_A
  FeatureSet faces_a{}, faces_b{};  ///< sets of the faces that bound the intersection
  FeatureSet edges_a{}, edges_b{};  ///< sets of the edges with a segment inside the other solid
};

/// The intersection A ∩ B in quadruple precision, a convex polyhedron in the body frame of A.
struct QuadIntersection {
  /// A polygon on a face of A or of B, counter-clockwise seen from outside.
  struct Polygon {
    std::vector<int> loop;  ///< indices of points
    int face = 0;           ///< index of the face of A or of B
    bool of_a = true;       ///< true for a face of A, false for a face of B
  };
  std::vector<Quad3> points;   ///< vertices of the polygons, and unused points that were cut off
  std::vector<Polygon> faces;  ///< all polygons that bound the intersection
};

/// Computes the intersection of A and B by cutting A with the face planes of B, one after another. The result is empty
/// if the solids are separated. It has no volume if they touch without a common volume.
QuadIntersection clipped_intersection(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);

/// Computes V, S_A and M_A of an intersection by the divergence theorem, and finds the faces and edges that bound it.
QuadOverlap overlap_of(const ConvexSolid& a, const ConvexSolid& b, const QuadIntersection& intersection);

/// Rounds to the nearest doubles. The result has OverlapPath::clip, unless the volume is 0.
Overlap narrowed(const QuadOverlap& exact);

/// Computes the overlap by clipping: overlap_of() of clipped_intersection(). overlap() uses this slow method for
/// degenerate pairs, and tests use it as a reference.
QuadOverlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose);
Overlap clipped_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

}  // namespace isojam
