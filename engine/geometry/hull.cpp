#include "engine/geometry/hull.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace isojam {

namespace {

// To decide which vertices form a face needs less precision than the constants of a solid.
using Vector3l = Eigen::Matrix<long double, 3, 1>;

long double extent(const std::vector<Vector3l>& points) {
  long double scale = 0;
  for (const Vector3l& point : points) scale = std::max(scale, point.norm());
  return scale;
}

/// Tolerance for vertices that were given in double and hence rounded.
long double rounding(long double scale) {
  return 64 * static_cast<long double>(std::numeric_limits<double>::epsilon()) * scale;
}

/// Vertices on the supporting plane through a, b, c; empty if these are collinear or the plane cuts the body.
std::vector<int> supporting_plane(const std::vector<Vector3l>& points, int a, int b, int c, long double scale) {
  const long double tolerance = rounding(scale);
  Vector3l normal = (points[b] - points[a]).cross(points[c] - points[a]);
  if (normal.norm() <= tolerance * scale) return {};
  normal.normalize();
  std::vector<int> on_plane;
  bool above = false, below = false;
  for (int k = 0; k < static_cast<int>(points.size()); ++k) {
    const long double distance = normal.dot(points[k] - points[a]);
    if (std::abs(distance) <= tolerance) {
      on_plane.push_back(k);
    } else {
      (distance > 0 ? above : below) = true;
    }
  }
  return above && below ? std::vector<int>{} : on_plane;
}

/// Orders the vertices of a face counter-clockwise about its outward normal, starting with the smallest index.
void order_counter_clockwise(FaceLoop& face, const Vector3l& normal, const std::vector<Vector3l>& points) {
  Vector3l centre = Vector3l::Zero();
  for (const int v : face) centre += points[v];
  centre /= static_cast<long double>(face.size());
  const Vector3l u = (points[face.front()] - centre).normalized();
  const Vector3l w = normal.cross(u);
  const auto angle = [&](int v) {
    const Vector3l d = points[v] - centre;
    const long double value = std::atan2(w.dot(d), u.dot(d));
    return value < -std::numeric_limits<double>::epsilon() ? value + 2 * std::numbers::pi_v<long double> : value;
  };
  std::sort(face.begin(), face.end(), [&](int p, int q) { return angle(p) < angle(q); });
}

std::vector<FaceLoop> supporting_faces(const std::vector<Vector3l>& points) {
  const int n = static_cast<int>(points.size());
  const long double scale = extent(points);
  Vector3l inside = Vector3l::Zero();
  for (const Vector3l& point : points) inside += point / static_cast<long double>(n);
  std::set<std::vector<int>> seen;
  std::vector<FaceLoop> faces;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      for (int c = b + 1; c < n; ++c) {
        std::vector<int> on_plane = supporting_plane(points, a, b, c, scale);
        if (on_plane.empty() || !seen.insert(on_plane).second) continue;
        Vector3l normal = (points[b] - points[a]).cross(points[c] - points[a]).normalized();
        if (normal.dot(points[a] - inside) < 0) normal = -normal;
        order_counter_clockwise(on_plane, normal, points);
        faces.push_back(std::move(on_plane));
      }
    }
  }
  return faces;
}

void refuse_coincident_points(const std::vector<Vector3l>& points) {
  const long double tolerance = rounding(extent(points));
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      if ((points[k] - points[other]).norm() <= tolerance)
        throw NoSolid("vertex " + std::to_string(k) + " is equal to vertex " + std::to_string(other),
                      static_cast<int>(k));
    }
  }
}

/// Number of faces that contain a point: at least three for a vertex, two on an edge, one on a face, none inside.
void refuse_inner_points(const std::vector<FaceLoop>& faces, std::size_t points) {
  std::vector<int> face_count(points, 0);
  for (const FaceLoop& face : faces) {
    for (const int v : face) ++face_count[static_cast<std::size_t>(v)];
  }
  for (std::size_t k = 0; k < points; ++k) {
    if (face_count[k] >= 3) continue;
    const char* where = face_count[k] == 2 ? "on an edge" : face_count[k] == 1 ? "on a face" : "inside";
    throw NoSolid("vertex " + std::to_string(k) + " is not a corner of the convex hull: it lies " + where +
                      " of the hull of the others",
                  static_cast<int>(k));
  }
}

}  // namespace

std::vector<FaceLoop> hull_faces(std::span<const Quad3> vertices) {
  std::vector<Vector3l> points;
  for (const Quad3& v : vertices)
    points.emplace_back(static_cast<long double>(v[0]), static_cast<long double>(v[1]), static_cast<long double>(v[2]));
  refuse_coincident_points(points);
  std::vector<FaceLoop> faces = supporting_faces(points);
  if (faces.size() < 4) throw NoSolid("the vertices span no volume");
  refuse_inner_points(faces, points.size());
  return faces;
}

}  // namespace isojam
