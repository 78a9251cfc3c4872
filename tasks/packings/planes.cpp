#include "tasks/packings/planes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/geometry/quad.hpp"
#include "tasks/packings/content_error.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr double parallel_planes = 1e-9;   ///< least volume that three unit normals span
constexpr double plane_tolerance = 1e-11;  ///< of a height above a plane, relative to the size

Vector3d intersection(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const Eigen::Vector4d& c) {
  const auto normal = [](const Eigen::Vector4d& plane) { return Quad3{plane[0], plane[1], plane[2]}; };
  const Quad3 bc = cross(normal(b), normal(c)), ca = cross(normal(c), normal(a)), ab = cross(normal(a), normal(b));
  return rounded(1 / dot(normal(a), bc) * (Quad(a[3]) * bc + Quad(b[3]) * ca + Quad(c[3]) * ab));
}

/// Without a bound there is a direction v with n·v ≤ 0 for all planes; it is then also so for the cross product of two
/// normals, or for one that is perpendicular to all of them.
bool is_bounded(std::span<const Vector3d> normals) {
  const auto recedes = [&](const Vector3d& v) {
    return std::all_of(normals.begin(), normals.end(), [&](const Vector3d& n) { return n.dot(v) <= plane_tolerance; });
  };
  for (std::size_t a = 0; a < normals.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Vector3d v = normals[a].cross(normals[b]);
      if (v.norm() > parallel_planes && (recedes(v.normalized()) || recedes(-v.normalized()))) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<Vector3d> corners_between(std::span<const Eigen::Vector4d> planes) {
  std::vector<Vector3d> normals, corners;
  std::vector<double> offsets;
  double size = 0;
  for (const auto& plane : planes) {
    const double length = plane.head<3>().norm();
    if (!(length > 0))
      throw ContentError(fmt::format("plane {} has no normal", normals.size()), "give it a normal other than 0");
    normals.emplace_back(plane.head<3>() / length);
    offsets.push_back(plane[3] / length);
    size = std::max(size, std::abs(offsets.back()));
  }
  if (!is_bounded(normals))
    throw ContentError("the planes do not bound a solid on all sides", "add the missing planes");
  const auto n = planes.size();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Vector3d line = normals[a].cross(normals[b]);
      for (std::size_t c = 0; c < b; ++c) {
        if (std::abs(line.dot(normals[c])) < parallel_planes) continue;
        const Vector3d near = (offsets[a] * normals[b].cross(normals[c]) + offsets[b] * normals[c].cross(normals[a]) +
                               offsets[c] * line) /
                              line.dot(normals[c]);
        const double margin = plane_tolerance * std::max(size, near.norm());
        bool inside = true;
        for (std::size_t k = 0; k < n && inside; ++k) inside = normals[k].dot(near) <= offsets[k] + margin;
        if (inside) corners.push_back(intersection(planes[a], planes[b], planes[c]));
      }
    }
  }
  if (corners.size() < 4) throw ContentError("no point is on the inner side of all planes", "n·x ≤ d must hold inside");
  return corners;
}

}  // namespace isojam
