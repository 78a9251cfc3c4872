#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// A triangle of a hull: the indices of its corners, counter-clockwise seen from outside.
using HullTriangle = std::array<int, 3>;

using DoubleDouble3 = std::array<DoubleDouble, 3>;  ///< a vector in double-double
/// The vector in double-double, rounded to the nearest.
inline DoubleDouble3 narrowed(const Quad3& p) { return {narrowed(p[0]), narrowed(p[1]), narrowed(p[2])}; }

/// The points in quadruple precision, without rounding.
std::vector<Quad3> widened(std::span<const Eigen::Vector3d> points);
/// Mean of the points.
Quad3 mean_of(std::span<const Quad3> points);

/// Points for exact tests of orientation. The origin is moved to the mean of the points, rounded to double. The points
/// are scaled by a power of two, so that the largest absolute value of a coordinate is between 1/4 and 1/2. If the
/// coordinates are doubles of similar magnitude, the scaled coordinates are exact.
class HullPoints {
 public:
  /// Throws NoSolid (hull.hpp) if there are fewer than four points or if all of them are equal.
  explicit HullPoints(std::span<const Quad3> points);

  int size() const { return static_cast<int>(exact_.size()); }                             ///< number of points
  const Quad3& operator[](int k) const { return exact_[static_cast<std::size_t>(k)]; }     ///< a point, scaled
  const Eigen::Vector3d& near(int k) const { return near_[static_cast<std::size_t>(k)]; }  ///< the point in double
  /// The point in double-double. Its error is 2⁻¹⁰⁷.
  const DoubleDouble3& fine(int k) const { return fine_[static_cast<std::size_t>(k)]; }
  Quad unit() const { return unit_; }              ///< unit of the scaled points, in units of the given points
  const Quad3& centre() const { return centre_; }  ///< origin of the scaled points, in the given coordinates

  /// Sign of the volume of the tetrahedron abcp: 1 if p is on the side from which abc is counter-clockwise, 0 if the
  /// four points are in one plane, otherwise −1. The sign is exact for the scaled points. It is computed in double
  /// first. Double-double, and then 640 bits, are used only if rounding errors could change the sign.
  int side(int a, int b, int c, int p) const;

 private:
  std::vector<Quad3> exact_;
  std::vector<Eigen::Vector3d> near_;
  std::vector<DoubleDouble3> fine_;
  Quad3 centre_{};
  Quad unit_ = 1;
};

/// Triangulates the convex hull of those points whose indices are in `use`, by adding one point after another. Points
/// inside the hull are in no triangle. Points that are exactly on a face or an edge may be in triangles. If points
/// coincide, at most one of them is a corner of triangles. A face with four or more corners is divided into triangles.
/// The time is O(n log n) if few triangles meet at each point. Throws NoSolid (hull.hpp) if all points are in a plane.
std::vector<HullTriangle> hull_triangles(const HullPoints& points, std::span<const int> use);

/// Six times the volume of a closed surface of polygons, which are lists of indices of `points`.
template <class Loops>
Quad six_volumes(const HullPoints& points, const Loops& faces) {
  Quad sum = 0;
  for (const auto& face : faces) {
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      sum += dot(points[face[0]], cross(points[face[k]], points[face[k + 1]]));
  }
  return sum;
}

}  // namespace isojam
