#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// A face of a convex polyhedron: vertex indices counter-clockwise seen from outside, starting with the smallest one.
using FaceLoop = std::vector<int>;

/// Error: the points are not the vertices of a convex polyhedron, or the polyhedron exceeds the program's limits.
class NoSolid : public std::invalid_argument {
 public:
  /// `why` is the message; `vertex` is the point that causes the error.
  explicit NoSolid(const std::string& why, int vertex = -1) : std::invalid_argument(why), vertex_(vertex) {}
  int vertex() const { return vertex_; }  ///< the point that causes the error, −1 if no single point does

 private:
  int vertex_;
};

/// Faces of the convex hull of points, ordered by their three smallest vertices. Each point must be a vertex of the
/// hull. A point lies on a plane if its distance is within the rounding of doubles: 64 ulp of the largest distance from
/// the origin. Brute force over triples: O(n⁴). Throws NoSolid for coincident points, for points that span no volume,
/// and for a point inside, on a face or on an edge of the hull of the others.
std::vector<FaceLoop> hull_faces(std::span<const Quad3> vertices);

}  // namespace isojam
