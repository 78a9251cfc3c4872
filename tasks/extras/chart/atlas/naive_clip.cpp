#include "tasks/extras/chart/atlas/naive_clip.hpp"

#include <Eigen/Geometry>
#include <vector>

namespace isojam {

namespace {

using Polygon = std::vector<Eigen::Vector3d>;

Polygon face_of(const PlacedSolid& solid, const Eigen::Vector3d& centre, int face) {
  Polygon polygon;
  for (const int v : solid.solid().faces()[static_cast<std::size_t>(face)].vertices)
    polygon.push_back(centre + solid.vertex(v));
  return polygon;
}

/// The part of the polygon with normal·y ≤ offset (algorithm of Sutherland and Hodgman).
Polygon clipped(const Polygon& polygon, const Eigen::Vector3d& normal, double offset) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double at_p = normal.dot(p) - offset, at_q = normal.dot(q) - offset;
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) kept.emplace_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return kept;
}

Eigen::Vector3d area_of(const Polygon& polygon) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    twice += (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]);
  return twice / 2;
}

/// Adds to `sum.volume` the contribution of the parts of the faces of `body` that lie inside `other`. Returns the
/// vector area of these parts.
Eigen::Vector3d add_faces(const PlacedSolid& body, const Eigen::Vector3d& centre, const PlacedSolid& other,
                          const Eigen::Vector3d& other_centre, VolumeAndArea& sum) {
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (int f = 0; f < body.faces(); ++f) {
    Polygon polygon = face_of(body, centre, f);
    for (int g = 0; g < other.faces() && !polygon.empty(); ++g)
      polygon = clipped(polygon, other.normal(g), other.offset()[g] + other.normal(g).dot(other_centre));
    const Eigen::Vector3d area = area_of(polygon);
    sum.volume += (body.offset()[f] + body.normal(f).dot(centre)) * area.dot(body.normal(f)) / 3;
    total += area;
  }
  return total;
}

}  // namespace

VolumeAndArea naive_overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  VolumeAndArea sum;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  // S_A = ∂V/∂x_A is the vector area of the faces of A inside B: if A moves, these faces sweep the gained volume.
  sum.area = add_faces(a, origin, b, r, sum);
  add_faces(b, r, a, origin, sum);
  return sum;
}

}  // namespace isojam
