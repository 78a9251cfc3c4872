#include "tests/oracle/random_orientations.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace isojam::oracle {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

double angle_between(const Vector3d& u, const Vector3d& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

double nearest_normal(const ConvexSolid& solid, const Vector3d& direction) {
  const auto& nearest = *std::max_element(
      solid.faces().begin(), solid.faces().end(),
      [&](const Face& a, const Face& b) { return a.normal.dot(direction) < b.normal.dot(direction); });
  return angle_between(nearest.normal, direction);
}

Vector3d along(const ConvexSolid& solid, const Edge& edge) {
  return (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).normalized();
}

/// Smallest elevation over the plane normal to `direction` of the edges that meet in the outermost vertex.
double least_elevation(const ConvexSolid& solid, const Vector3d& direction) {
  const auto& vertices = solid.vertices();
  const auto outermost = std::max_element(vertices.begin(), vertices.end(), [&](const Vector3d& u, const Vector3d& v) {
    return u.dot(direction) < v.dot(direction);
  });
  double least = 1;
  for (const Edge& edge : solid.edges()) {
    if (outermost - vertices.begin() == edge.tail || outermost - vertices.begin() == edge.head)
      least = std::min(least, std::abs(along(solid, edge).dot(direction)));
  }
  return std::asin(least);
}

}  // namespace

std::vector<AlignmentAngles> sample_unconstrained(const ConvexSolid& solid, int n, RandomStream& random) {
  std::vector<AlignmentAngles> sample;
  for (int k = 0; k < n; ++k) {
    const double z = 2 * random.uniform() - 1, azimuth = 2 * pi * random.uniform(), r = std::sqrt(1 - z * z);
    const Vector3d direction(r * std::cos(azimuth), r * std::sin(azimuth), z);
    sample.push_back({nearest_normal(solid, direction), least_elevation(solid, direction)});
  }
  return sample;
}

std::vector<AlignmentAngles> sample_edge_constrained(const ConvexSolid& solid, int n, RandomStream& random) {
  std::vector<AlignmentAngles> sample;
  for (int k = 0; k < n; ++k) {
    const auto chosen = static_cast<std::size_t>(random.uniform() * static_cast<double>(solid.edges().size()));
    const Edge& edge = solid.edges()[chosen];
    const Vector3d &left = solid.faces()[edge.left].normal, &right = solid.faces()[edge.right].normal;
    const double angle = angle_between(left, right), part = random.uniform();
    const Vector3d direction = (std::sin((1 - part) * angle) * left + std::sin(part * angle) * right) / std::sin(angle);
    sample.push_back({nearest_normal(solid, direction), std::abs(std::asin(along(solid, edge).dot(direction)))});
  }
  return sample;
}

}  // namespace isojam::oracle
