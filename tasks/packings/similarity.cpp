#include "tasks/packings/similarity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace isojam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// In units of the size of a solid: rounding of vertices in single precision or in a file with few digits.
constexpr double tolerance = 1e-4;

Matrix3d frame(const Vector3d& a, const Vector3d& b) {
  Matrix3d axes;
  axes.col(0) = a.normalized();
  axes.col(2) = a.cross(b).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// True if every point of one list coincides with a point of the rotated other list.
bool coincide(const std::vector<Vector3d>& points, const std::vector<Vector3d>& others, const Matrix3d& rotation,
              double near) {
  return std::all_of(points.begin(), points.end(), [&](const Vector3d& point) {
    const Vector3d turned = rotation * point;
    return std::any_of(others.begin(), others.end(),
                       [&](const Vector3d& other) { return (turned - other).norm() <= near; });
  });
}

/// Points relative to their mean, which transforms as the centroid does, in units of their root mean square distance.
struct Normalised {
  Vector3d mean = Vector3d::Zero();
  double size = 0;
  std::vector<Vector3d> points;
};

Normalised normalised(std::span<const Vector3d> points) {
  Normalised result;
  const auto n = static_cast<double>(points.size());
  for (const Vector3d& point : points) result.mean += point / n;
  for (const Vector3d& point : points) result.size += (point - result.mean).squaredNorm() / n;
  result.size = std::sqrt(result.size);
  for (const Vector3d& point : points) result.points.emplace_back((point - result.mean) / result.size);
  return result;
}

std::optional<Matrix3d> rotation_onto(const std::vector<Vector3d>& own, const std::vector<Vector3d>& others) {
  // Two vectors far from parallel. Each pair of vectors to which they can be mapped gives a candidate rotation.
  const Vector3d& a = own[0];
  const Vector3d& b = *std::max_element(own.begin(), own.end(), [&](const Vector3d& p, const Vector3d& q) {
    return a.cross(p).squaredNorm() < a.cross(q).squaredNorm();
  });
  const Matrix3d own_frame = frame(a, b);
  for (const Vector3d& p : others) {
    if (std::abs(p.norm() - a.norm()) > tolerance) continue;
    for (const Vector3d& q : others) {
      if (std::abs(q.norm() - b.norm()) > tolerance || std::abs((p - q).norm() - (a - b).norm()) > 2 * tolerance)
        continue;
      const Matrix3d rotation = frame(p, q) * own_frame.transpose();
      if (coincide(own, others, rotation, 4 * tolerance)) return rotation;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Similarity> similarity(const ConvexSolid& solid, std::span<const Eigen::Vector3d> points) {
  if (points.size() != solid.vertices().size()) return std::nullopt;
  const Normalised own = normalised(solid.vertices()), others = normalised(points);
  if (!(others.size > 0) || !std::isfinite(others.size)) return std::nullopt;
  const auto rotation = rotation_onto(own.points, others.points);
  if (!rotation) return std::nullopt;
  const double scale = others.size / own.size;
  return Similarity{Eigen::Quaterniond(*rotation).normalized(), others.mean - scale * (*rotation * own.mean), scale};
}

}  // namespace isojam
