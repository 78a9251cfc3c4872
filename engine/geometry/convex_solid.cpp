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

/// A face of the hull: its vertices counter-clockwise seen from outside.
using Loop = std::vector<int>;

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
void order_counter_clockwise(Loop& face, const Vector3l& normal, const std::vector<Vector3l>& points) {
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

std::vector<Loop> hull(const std::vector<Vector3l>& points) {
  const int n = static_cast<int>(points.size());
  const long double scale = extent(points);
  Vector3l inside = Vector3l::Zero();
  for (const Vector3l& point : points) inside += point / static_cast<long double>(n);
  std::set<std::vector<int>> seen;
  std::vector<Loop> faces;
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

struct Plane {
  Quad3 normal{};
  Quad offset = 0;
};

/// Newell's normal: exact for a planar polygon, the least-squares one for rounded vertices.
Plane fitted_plane(const Loop& face, const std::vector<Quad3>& points) {
  Plane plane;
  Quad3 centre{};
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Quad3& p = points[face[k]];
    plane.normal = plane.normal + cross(p, points[face[(k + 1) % face.size()]]);
    centre = centre + p;
  }
  plane.normal = (1 / norm(plane.normal)) * plane.normal;
  plane.offset = dot(plane.normal, centre) / Quad(face.size());
  return plane;
}

struct Moments {
  Quad volume = 0;
  Quad3 first{};    ///< ∫ x dV
  Quad second = 0;  ///< ∫ |x|² dV
};

Moments moments(const std::vector<Quad3>& points, const std::vector<Loop>& faces) {
  Moments m;
  for (const Loop& face : faces) {
    const Quad3& a = points[face[0]];
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Quad3& b = points[face[k]];
      const Quad3& c = points[face[k + 1]];
      const Quad det = dot(a, cross(b, c));
      const Quad3 s = a + b + c;
      m.volume += det / 6;
      m.first = m.first + det / 24 * s;
      m.second += det / 120 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(s, s));
    }
  }
  return m;
}

/// Edges tail < head, in order of (tail, head).
std::vector<Edge> find_edges(const std::vector<Loop>& faces) {
  std::map<std::pair<int, int>, int> left_of;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    const Loop& v = faces[f];
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

double height(const Plane& plane, const Loop& face, const Quad3& vertex, int v) {
  if (std::find(face.begin(), face.end(), v) != face.end()) return 0;
  return static_cast<double>(dot(plane.normal, vertex) - plane.offset);
}

void flatten_edges(const std::vector<Edge>& edges, SolidArrays& flat) {
  flat.edges = static_cast<int>(edges.size());
  for (int k = 0; k < SolidArrays::capacity; ++k) {
    const Edge& e = flat.edge[k] = edges[k < flat.edges ? k : 0];
    flat.tail[k] = static_cast<std::uint8_t>(e.tail), flat.head[k] = static_cast<std::uint8_t>(e.head);
    const auto left = static_cast<std::uint32_t>(e.left), right = static_cast<std::uint32_t>(e.right);
    flat.record[k] = {flat.tail[k],
                      flat.head[k],
                      static_cast<std::uint16_t>(left),
                      static_cast<std::uint16_t>(right),
                      static_cast<std::uint16_t>(SolidArrays::at(flat.tail[k])),
                      static_cast<std::uint16_t>(SolidArrays::at(flat.head[k])),
                      std::uint32_t{1} << left | std::uint32_t{1} << right,
                      {left << 5 | right << 21, right | left << 16}};
    if (k >= flat.edges) continue;
    const Parts edge{std::uint32_t{1} << e.tail | std::uint32_t{1} << e.head, std::uint32_t{1} << k,
                     flat.record[k].faces};
    flat.star[e.tail] |= edge, flat.star[e.head] |= edge;
  }
}

SolidArrays flatten(const std::vector<Quad3>& vertices, const std::vector<Plane>& planes,
                    const std::vector<Loop>& faces, const std::vector<Edge>& edges) {
  SolidArrays flat;
  flat.vertices = static_cast<int>(vertices.size());
  flat.faces = static_cast<int>(planes.size());
  const Plane nowhere{{}, SolidArrays::far};
  const auto store = [](Quad value, double& high, double& low) {
    high = narrowed(value).high;
    low = narrowed(value).low;
  };
  for (int k = 0; k < SolidArrays::capacity; ++k) {
    const Quad3& v = vertices[k < flat.vertices ? k : 0];
    const Plane& plane = k < flat.faces ? planes[k] : nowhere;
    store(v[0], flat.x[k], flat.x_low[k]);
    store(v[1], flat.y[k], flat.y_low[k]);
    store(v[2], flat.z[k], flat.z_low[k]);
    store(plane.normal[0], flat.nx[k], flat.nx_low[k]);
    store(plane.normal[1], flat.ny[k], flat.ny_low[k]);
    store(plane.normal[2], flat.nz[k], flat.nz_low[k]);
    store(plane.offset, flat.offset[k], flat.offset_low[k]);
    for (int p = 0; p < SolidArrays::capacity; ++p) {
      const int own = p < flat.vertices ? p : 0;
      flat.height[k][p] = height(plane, faces[k < flat.faces ? k : 0], vertices[own], own);
    }
  }
  flatten_edges(edges, flat);
  return flat;
}

std::vector<Quad3> widened(std::span<const Eigen::Vector3d> vertices) {
  std::vector<Quad3> result;
  for (const Eigen::Vector3d& v : vertices) result.push_back({v.x(), v.y(), v.z()});
  return result;
}

std::vector<Vector3l> extended(std::span<const Quad3> vertices) {
  std::vector<Vector3l> result;
  for (const Quad3& v : vertices)
    result.emplace_back(static_cast<long double>(v[0]), static_cast<long double>(v[1]), static_cast<long double>(v[2]));
  return result;
}

}  // namespace

ConvexSolid::ConvexSolid(std::string name, std::span<const Eigen::Vector3d> vertices)
    : ConvexSolid(std::move(name), widened(vertices)) {}

ConvexSolid::ConvexSolid(std::string name, std::span<const Quad3> vertices) : name_(std::move(name)) {
  if (vertices.size() < 4 || vertices.size() > max_features)
    throw std::invalid_argument("a solid has 4 to 32 vertices");
  // Which vertices make a face is safe to decide in less precision than the constants have.
  const std::vector<Loop> loops = hull(extended(vertices));
  if (loops.size() < 4) throw std::invalid_argument("the vertices span no volume");
  edges_ = find_edges(loops);
  if (loops.size() > max_features || edges_.size() > max_features)
    throw std::invalid_argument("a solid has at most 32 faces and 32 edges");
  if (vertices.size() + loops.size() != edges_.size() + 2) throw std::invalid_argument("a vertex is not extreme");

  std::vector<Quad3> points(vertices.begin(), vertices.end());
  const Moments raw = moments(points, loops);
  const Quad3 centroid = (1 / raw.volume) * raw.first;
  const Quad scale = 1 / cube_root(raw.volume);
  for (Quad3& point : points) point = scale * (point - centroid);
  std::vector<Plane> planes;
  for (const Loop& loop : loops) planes.push_back(fitted_plane(loop, points));

  for (const Quad3& point : points) {
    vertices_.push_back(rounded(point));
    circumradius_ = std::max(circumradius_, static_cast<double>(norm(point)));
    for (const Quad3& other : points) diameter_ = std::max(diameter_, static_cast<double>(norm(point - other)));
  }
  inradius_ = circumradius_;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    faces_.push_back({rounded(planes[f].normal), static_cast<double>(planes[f].offset), loops[f]});
    inradius_ = std::min(inradius_, faces_.back().offset);
  }
  gyration_radius_ = static_cast<double>(square_root(2 * moments(points, loops).second / 3));
  arrays_ = flatten(points, planes, loops, edges_);
}

}  // namespace isojam
