#include "tasks/packings/planes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/geometry/quad.hpp"
#include "tasks/packings/content_error.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double parallel_planes = 1e-9;   ///< least volume that three unit normals span
constexpr double plane_tolerance = 1e-11;  ///< of a height above a plane, relative to the size
/// Sine of the angle of two planes below which their line has a larger error than plane_tolerance. Its corners are also
/// on other lines, except for the tip of a pyramid that is as flat, which is left out.
constexpr double inaccurate_line = 1e-5;
constexpr double shortest_edge = 1e-9;  ///< relative to the size

Vector3d intersection(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const Eigen::Vector4d& c) {
  const auto normal = [](const Eigen::Vector4d& plane) { return Quad3{plane[0], plane[1], plane[2]}; };
  const Quad3 bc = cross(normal(b), normal(c)), ca = cross(normal(c), normal(a)), ab = cross(normal(a), normal(b));
  return rounded(1 / dot(normal(a), bc) * (Quad(a[3]) * bc + Quad(b[3]) * ca + Quad(c[3]) * ab));
}

using End = std::pair<double, std::size_t>;  ///< place on the line of two planes, and a third plane

/// Cuts off the part of an edge that is not on the inner side of the plane c. Each edge is what all planes leave. Its
/// own two are parallel to it.
void cut(End& low, End& high, std::size_t c, double along, double room, double scale) {
  if (std::abs(along) < parallel_planes) {
    if (room < -plane_tolerance * scale) high.first = -infinity;
  } else if (along > 0) {
    high = std::min(high, {room / along, c});
  } else {
    low = std::max(low, {room / along, c});
  }
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
  for (std::size_t a = 0; a < planes.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Vector3d line = normals[a].cross(normals[b]);
      if (line.norm() < inaccurate_line) continue;
      const Vector3d foot = (offsets[a] * normals[b] - offsets[b] * normals[a]).cross(line) / line.squaredNorm();
      const double scale = std::max(size, foot.norm());
      End low{-infinity, a}, high{infinity, a};
      for (std::size_t c = 0; c < planes.size() && low.first <= high.first; ++c)
        cut(low, high, c, normals[c].dot(line), offsets[c] - normals[c].dot(foot), scale);
      // In the tip of a pyramid, the lines of nearly all pairs meet, but only neighbours have an edge.
      const double length = (high.first - low.first) * line.norm();
      if (!(length > shortest_edge * scale)) continue;
      if (std::isinf(length))
        throw ContentError("the planes do not bound a solid on all sides", "add the missing planes");
      for (const auto& [t, c] : {low, high}) {
        const Vector3d near = foot + t * line;
        const auto is_near = [&](const Vector3d& corner) { return (corner - near).norm() <= plane_tolerance * scale; };
        if (std::none_of(corners.begin(), corners.end(), is_near))
          corners.push_back(intersection(planes[a], planes[b], planes[c]));
      }
    }
  }
  if (corners.size() < 4) throw ContentError("the planes enclose no solid", "n·x ≤ d must hold inside");
  return corners;
}

}  // namespace isojam
