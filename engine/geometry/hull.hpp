#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// A face of a convex polyhedron: its vertices counter-clockwise seen from outside, from the least index on.
using FaceLoop = std::vector<int>;

/// Points that are not the vertices of a convex polyhedron, or of none that the program can hold.
class NoSolid : public std::invalid_argument {
 public:
  /// Says why, and which point is to blame.
  explicit NoSolid(const std::string& why, int vertex = -1) : std::invalid_argument(why), vertex_(vertex) {}
  int vertex() const { return vertex_; }  ///< the point that is to blame, −1 if all are

 private:
  int vertex_;
};

/// The faces of the hull of points each of which is a vertex of it, in order of their three least vertices. Points
/// within the rounding of doubles of a plane lie on it, 64 ulp of the greatest distance from the origin. By brute force
/// over triples: O(n⁴). Throws NoSolid for two points that are one, for points that span no volume, and for a point
/// inside, on a face or on an edge of the hull of the others.
std::vector<FaceLoop> hull_faces(std::span<const Quad3> vertices);

}  // namespace isojam
