#include "engine/geometry/convex_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

namespace isojam {

namespace {

using Vector3l = Eigen::Matrix<long double, 3, 1>;
using Matrix3l = Eigen::Matrix<long double, 3, 3>;

struct HullFace {
  Vector3l normal;
  long double offset = 0;
  std::vector<int> vertices;
};

long double extent(const std::vector<Vector3l>& points) {
  long double scale = 0;
  for (const Vector3l& point : points) scale = std::max(scale, point.norm());
  return scale;
}

/// Vertices of the supporting plane through a, b, c; empty if they are collinear or the plane cuts the body.
std::vector<int> supporting_plane(const std::vector<Vector3l>& points, int a, int b, int c, long double scale) {
  // Vertices given in double are coplanar only to their own rounding.
  const long double tolerance = 64 * static_cast<long double>(std::numeric_limits<double>::epsilon()) * scale;
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

/// Orders the vertices of a face counter-clockwise about its outward normal, starting from the least index.
void order_counter_clockwise(HullFace& face, const std::vector<Vector3l>& points) {
  Vector3l centre = Vector3l::Zero();
  for (const int v : face.vertices) centre += points[v];
  centre /= static_cast<long double>(face.vertices.size());
  const Vector3l u = (points[face.vertices.front()] - centre).normalized();
  const Vector3l w = face.normal.cross(u);
  const auto angle = [&](int v) {
    const Vector3l d = points[v] - centre;
    const long double value = std::atan2(w.dot(d), u.dot(d));
    return value < -std::numeric_limits<double>::epsilon() ? value + 2 * std::numbers::pi_v<long double> : value;
  };
  std::sort(face.vertices.begin(), face.vertices.end(), [&](int p, int q) { return angle(p) < angle(q); });
}

/// Newell's normal: exact for a planar polygon, the least-squares one for rounded vertices.
void fit_plane(HullFace& face, const std::vector<Vector3l>& points) {
  Vector3l normal = Vector3l::Zero();
  Vector3l centre = Vector3l::Zero();
  for (std::size_t k = 0; k < face.vertices.size(); ++k) {
    const Vector3l& p = points[face.vertices[k]];
    const Vector3l& q = points[face.vertices[(k + 1) % face.vertices.size()]];
    normal += p.cross(q);
    centre += p;
  }
  face.normal = normal.normalized();
  face.offset = face.normal.dot(centre) / static_cast<long double>(face.vertices.size());
}

std::vector<HullFace> hull(const std::vector<Vector3l>& points) {
  const int n = static_cast<int>(points.size());
  const long double scale = extent(points);
  Vector3l inside = Vector3l::Zero();
  for (const Vector3l& point : points) inside += point / static_cast<long double>(n);
  std::set<std::vector<int>> seen;
  std::vector<HullFace> faces;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      for (int c = b + 1; c < n; ++c) {
        std::vector<int> on_plane = supporting_plane(points, a, b, c, scale);
        if (on_plane.empty() || !seen.insert(on_plane).second) continue;
        HullFace face;
        face.normal = (points[b] - points[a]).cross(points[c] - points[a]).normalized();
        if (face.normal.dot(points[a] - inside) < 0) face.normal = -face.normal;
        face.vertices = std::move(on_plane);
        order_counter_clockwise(face, points);
        fit_plane(face, points);
        faces.push_back(std::move(face));
      }
    }
  }
  return faces;
}

struct Moments {
  long double volume = 0;
  Vector3l first = Vector3l::Zero();   ///< ∫ x dV
  Matrix3l second = Matrix3l::Zero();  ///< ∫ x xᵀ dV
};

Moments moments(const std::vector<Vector3l>& points, const std::vector<HullFace>& faces) {
  Moments m;
  for (const HullFace& face : faces) {
    const Vector3l& a = points[face.vertices[0]];
    for (std::size_t k = 1; k + 1 < face.vertices.size(); ++k) {
      const Vector3l& b = points[face.vertices[k]];
      const Vector3l& c = points[face.vertices[k + 1]];
      const long double det = a.dot(b.cross(c));
      const Vector3l s = a + b + c;
      m.volume += det / 6;
      m.first += det / 24 * s;
      m.second += det / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
  }
  return m;
}

/// Edges tail < head, in order of (tail, head).
std::vector<Edge> find_edges(const std::vector<HullFace>& faces) {
  std::map<std::pair<int, int>, int> left_of;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    const std::vector<int>& v = faces[f].vertices;
    for (std::size_t k = 0; k < v.size(); ++k) left_of[{v[k], v[(k + 1) % v.size()]}] = f;
  }
  std::vector<Edge> edges;
  for (const auto& [ends, left] : left_of) {
    const auto back = left_of.find({ends.second, ends.first});
    if (back == left_of.end()) throw std::invalid_argument("the faces do not close a convex polyhedron");
    if (ends.first < ends.second) edges.push_back({ends.first, ends.second, left, back->second});
  }
  return edges;
}

double height(const Face& face, const std::vector<Eigen::Vector3d>& vertices, int v) {
  if (std::find(face.vertices.begin(), face.vertices.end(), v) != face.vertices.end()) return 0;
  return static_cast<double>(face.normal.cast<long double>().dot(vertices[v].cast<long double>()) - face.offset);
}

void flatten_edges(const std::vector<Edge>& edges, SolidArrays& flat) {
  flat.edges = static_cast<int>(edges.size());
  for (int v = 0; v < SolidArrays::capacity; ++v) flat.around[v] = std::uint32_t{1} << v, flat.edges_at[v] = 0;
  for (int k = 0; k < SolidArrays::capacity; ++k) {
    const Edge& e = flat.edge[k] = edges[k < flat.edges ? k : 0];
    flat.tail[k] = static_cast<std::uint8_t>(e.tail), flat.head[k] = static_cast<std::uint8_t>(e.head);
    const auto left = static_cast<std::uint32_t>(e.left), right = static_cast<std::uint32_t>(e.right);
    flat.record[k] = {flat.tail[k],
                      flat.head[k],
                      static_cast<std::uint16_t>(left),
                      static_cast<std::uint16_t>(right),
                      std::uint32_t{1} << left | std::uint32_t{1} << right,
                      {left << 5 | right << 21, right | left << 16}};
    if (k >= flat.edges) continue;
    flat.around[e.tail] |= std::uint32_t{1} << e.head, flat.around[e.head] |= std::uint32_t{1} << e.tail;
    flat.edges_at[e.tail] |= std::uint32_t{1} << k, flat.edges_at[e.head] |= std::uint32_t{1} << k;
  }
}

SolidArrays flatten(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Face>& faces,
                    const std::vector<Edge>& edges) {
  SolidArrays flat;
  flat.vertices = static_cast<int>(vertices.size());
  flat.faces = static_cast<int>(faces.size());
  const Face nowhere{Eigen::Vector3d::Zero(), SolidArrays::far, {}};
  for (int k = 0; k < SolidArrays::capacity; ++k) {
    const Eigen::Vector3d& v = vertices[k < flat.vertices ? k : 0];
    const Face& f = k < flat.faces ? faces[k] : nowhere;
    flat.x[k] = v.x(), flat.y[k] = v.y(), flat.z[k] = v.z();
    flat.nx[k] = f.normal.x(), flat.ny[k] = f.normal.y(), flat.nz[k] = f.normal.z(), flat.offset[k] = f.offset;
    for (int p = 0; p < SolidArrays::capacity; ++p) flat.height[k][p] = height(f, vertices, p < flat.vertices ? p : 0);
  }
  flatten_edges(edges, flat);
  return flat;
}

std::vector<Vector3l> extended(std::span<const Eigen::Vector3d> vertices) {
  std::vector<Vector3l> result;
  for (const Eigen::Vector3d& v : vertices) result.push_back(v.cast<long double>());
  return result;
}

}  // namespace

ConvexSolid::ConvexSolid(std::string name, std::span<const Eigen::Vector3d> vertices)
    : ConvexSolid(std::move(name), extended(vertices)) {}

ConvexSolid::ConvexSolid(std::string name, std::span<const Vector3l> vertices) : name_(std::move(name)) {
  if (vertices.size() < 4 || vertices.size() > max_features)
    throw std::invalid_argument("a solid has 4 to 32 vertices");
  std::vector<Vector3l> points(vertices.begin(), vertices.end());
  std::vector<HullFace> hull_faces = hull(points);
  if (hull_faces.size() < 4) throw std::invalid_argument("the vertices span no volume");
  const Moments raw = moments(points, hull_faces);
  const Vector3l centroid = raw.first / raw.volume;
  const long double scale = 1 / std::cbrt(raw.volume);
  for (Vector3l& point : points) point = scale * (point - centroid);
  for (HullFace& face : hull_faces) fit_plane(face, points);
  edges_ = find_edges(hull_faces);
  if (hull_faces.size() > max_features || edges_.size() > max_features)
    throw std::invalid_argument("a solid has at most 32 faces and 32 edges");
  if (vertices.size() + hull_faces.size() != edges_.size() + 2) throw std::invalid_argument("a vertex is not extreme");

  for (const Vector3l& point : points) {
    vertices_.push_back(point.cast<double>());
    circumradius_ = std::max(circumradius_, static_cast<double>(point.norm()));
    for (const Vector3l& other : points) diameter_ = std::max(diameter_, static_cast<double>((point - other).norm()));
  }
  inradius_ = circumradius_;
  for (const HullFace& face : hull_faces) {
    faces_.push_back({face.normal.cast<double>(), static_cast<double>(face.offset), face.vertices});
    inradius_ = std::min(inradius_, faces_.back().offset);
  }
  gyration_radius_ = static_cast<double>(std::sqrt(2 * moments(points, hull_faces).second.trace() / 3));
  arrays_ = flatten(vertices_, faces_, edges_);
}

}  // namespace isojam
