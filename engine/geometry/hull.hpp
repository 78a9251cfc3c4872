#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// A face of a convex polyhedron: the indices of its vertices, counter-clockwise seen from outside. The smallest index
/// comes first.
using FaceLoop = std::vector<int>;

/// Exception: the points are not the vertices of a convex polyhedron, or the polyhedron has too many features for the
/// program.
class NoSolid : public std::invalid_argument {
 public:
  /// `why` is the message. `vertex` is the index of the point that causes the error, or −1.
  explicit NoSolid(const std::string& why, int vertex = -1) : std::invalid_argument(why), vertex_(vertex) {}
  int vertex() const { return vertex_; }  ///< index of the point that causes the error; −1 if there is no such point

 private:
  int vertex_;
};

/// Computes the faces of the convex hull of points, sorted by their three smallest vertices. Each point must be a
/// vertex of the hull. A point counts as lying on a plane if its distance from the plane is at most 64 ulp of the
/// largest distance of a point from the origin. The function tests all triples of points and takes a time O(n⁴). It
/// throws NoSolid if two points coincide, if the points span no volume, or if a point is inside the hull of the other
/// points, on one of its faces or on one of its edges.
std::vector<FaceLoop> hull_faces(std::span<const Quad3> vertices);

}  // namespace isojam
