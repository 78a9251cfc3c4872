#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/geometry/hull_triangles.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// A face of a convex polyhedron: the indices of its vertices, counter-clockwise seen from outside. The smallest index
/// comes first.
using FaceLoop = std::vector<int>;

/// Exception: the points are not the vertices of a convex polyhedron, or the polyhedron has too many features for the
/// program.
class NoSolid : public std::invalid_argument {
 public:
  /// Causes that a repair (repair.hpp) can remove.
  enum class Cause {
    other,
    equal_points,  ///< two points coincide
    not_a_corner,  ///< a point is not a corner of the hull
    too_large,     ///< there are more features than the program supports
    not_planar,    ///< a face cannot be made planar by small moves of its corners
    too_coarse     ///< a repair would change the solid by more than is allowed
  };
  /// `why` is the message. `vertex` is the index of the point that causes the error, or −1.
  explicit NoSolid(const std::string& why, Cause cause = Cause::other, int vertex = -1)
      : std::invalid_argument(why), cause_(cause), vertex_(vertex) {}
  Cause cause() const { return cause_; }  ///< the cause of the error
  int vertex() const { return vertex_; }  ///< index of the point that causes the error; −1 if there is no such point

 private:
  Cause cause_;
  int vertex_;
};

/// Tolerance for points that were computed and written in double: 64 ulp of the size of the point set or of its largest
/// coordinate, whichever is larger. The size is the largest distance of a point from the mean of all points. The result
/// is in the unit of the points.
Quad rounding_tolerance(std::span<const Quad3> points);

/// Joins triangles of a convex hull to faces. A face consists of triangles that share edges, and all of its corners are
/// within `tolerance` (in units of points.unit()) of its plane. The normal of this plane is the sum of the area vectors
/// of the triangles, and the plane contains the mean of the corners. Each step joins the two neighbouring faces whose
/// corners have the smallest maximum distance from their common plane. A point in which fewer than three faces meet is
/// then removed from these faces. The faces are sorted by their three smallest vertices. Throws NoSolid if the faces do
/// not bound a convex polyhedron.
std::vector<FaceLoop> joined_faces(const HullPoints& points, std::span<const HullTriangle> triangles, double tolerance);

/// For each point, the index of its representative: the first representative that is at most `distance` away, or the
/// point itself if there is none. The time is O(n²) in the worst case, if all points have the same x.
std::vector<std::size_t> welded(std::span<const Eigen::Vector3d> points, double distance);

/// Throws NoSolid if two points are nearer than `tolerance` (in units of points.unit()).
void refuse_equal_points(const HullPoints& points, double tolerance);

/// Throws NoSolid if a point whose index is in `use` is not a corner of a face. The message states whether the point is
/// on an edge, on a face or inside, within `tolerance` (in units of points.unit()).
void refuse_other_points(const HullPoints& points, std::span<const int> use, std::span<const FaceLoop> faces,
                         double tolerance);

/// Throws NoSolid if a solid with these faces has more vertices, edges or faces than ConvexSolid (convex_solid.hpp)
/// allows.
void refuse_large(std::size_t vertices, std::span<const FaceLoop> faces);

/// Computes the faces of the convex hull of points, sorted by their three smallest vertices. Each point must be a
/// vertex of the hull. Vertices belong to the same face if their distance from its plane is at most
/// rounding_tolerance(). Throws NoSolid if two points coincide within this tolerance, if the points span no volume, or
/// if a point is inside the hull of the other points, on one of its faces or on one of its edges.
std::vector<FaceLoop> hull_faces(std::span<const Quad3> vertices);

}  // namespace isojam
