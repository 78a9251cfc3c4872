#include "engine/geometry/hull_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "engine/geometry/hull.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;

/// Differences of numbers in quadruple precision have at most 128 bits, unless their magnitudes differ by more than
/// 2^15. A product of three of them then has 384, and the sum of six such products 387.
using Exact =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<640, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;
using Exact3 = std::array<Exact, 3>;

Exact exact(Quad x) {
  const auto high = static_cast<double>(x);
  const auto middle = static_cast<double>(x - Quad(high));
  return Exact(high) + Exact(middle) + Exact(static_cast<double>(x - Quad(high) - Quad(middle)));
}

Exact3 exact_difference(const Quad3& p, const Quad3& q) {
  return {exact(p[0]) - exact(q[0]), exact(p[1]) - exact(q[1]), exact(p[2]) - exact(q[2])};
}

template <class Vector>
auto determinant(const Vector& u, const Vector& v, const Vector& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/// Bound for the error of a determinant of differences of points, in units of the rounding unit. All coordinates are
/// below 1/2, so each of the six products is below 1. It has fewer than eight rounding errors of at most one unit.
constexpr double determinant_error = 64;

template <class Number>
int sign(const Number& value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

}  // namespace

std::vector<Quad3> widened(std::span<const Vector3d> points) {
  std::vector<Quad3> result;
  for (const Vector3d& p : points) result.push_back({p.x(), p.y(), p.z()});
  return result;
}

Quad3 mean_of(std::span<const Quad3> points) {
  Quad3 mean{};
  for (const Quad3& point : points) mean = mean + (1 / Quad(points.size())) * point;
  return mean;
}

HullPoints::HullPoints(std::span<const Quad3> points) : exact_(points.begin(), points.end()) {
  if (points.size() < 4)
    throw NoSolid("the solid has " + std::to_string(points.size()) + " vertices, but needs at least 4");
  centre_ = mean_of(points);
  // The centre is rounded to double, so that differences from it are exact for points that are doubles.
  for (Quad& c : centre_) c = static_cast<double>(c);
  double largest = 0;
  for (Quad3& point : exact_) {
    point = point - centre_;
    for (const Quad c : point) largest = std::max(largest, std::abs(static_cast<double>(c)));
  }
  if (!(largest > 0)) throw NoSolid("all vertices are in one place");
  int exponent = 0;
  std::frexp(largest, &exponent);
  unit_ = std::ldexp(1.0, exponent + 1);
  for (Quad3& point : exact_) {
    point = (1 / unit_) * point;
    near_.push_back(rounded(point));
  }
}

int HullPoints::side(int a, int b, int c, int p) const {
  const Vector3d& o = near(a);
  const double coarse = determinant<Vector3d>(near(b) - o, near(c) - o, near(p) - o);
  if (std::abs(coarse) > determinant_error * std::numeric_limits<double>::epsilon()) return sign(coarse);
  const HullPoints& points = *this;
  const Quad fine = determinant(points[b] - points[a], points[c] - points[a], points[p] - points[a]);
  constexpr double quad_epsilon = 0x1p-112;
  if (fine > determinant_error * quad_epsilon || fine < -determinant_error * quad_epsilon) return sign(fine);
  return sign(determinant(exact_difference(points[b], points[a]), exact_difference(points[c], points[a]),
                          exact_difference(points[p], points[a])));
}

namespace {

/// Indices of the first four corners. They are far apart, so that most other points are inside their tetrahedron.
std::array<int, 4> first_corners(const HullPoints& points, std::span<const int> use) {
  const auto farthest = [&](const auto& distance) {
    int best = use.front();
    Quad largest = distance(points[best]);
    for (const int k : use) {
      const Quad value = distance(points[k]);
      if (value > largest) best = k, largest = value;
    }
    return best;
  };
  const auto squared = [](const Quad3& v) { return dot(v, v); };
  const int a = farthest([&](const Quad3& p) { return squared(p); });
  const int b = farthest([&](const Quad3& p) { return squared(p - points[a]); });
  const Quad3 along = points[b] - points[a];
  const int c = farthest([&](const Quad3& p) { return squared(cross(along, p - points[a])); });
  const Quad3 normal = cross(along, points[c] - points[a]);
  const int d = farthest([&](const Quad3& p) {
    const Quad height = dot(normal, p - points[a]);
    return height < 0 ? -height : height;
  });
  const int side = points.side(a, b, c, d);
  if (side == 0) throw NoSolid("all vertices are in one plane");
  return side > 0 ? std::array{a, c, b, d} : std::array{a, b, c, d};
}

/// Number of the directed edge from a to b.
std::uint64_t directed(int a, int b) { return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b); }

/// Adds a point to a convex hull: replaces the triangles that see it by triangles from it to their outline.
void add(int p, const HullPoints& points, std::vector<HullTriangle>& triangles) {
  const auto hidden = std::stable_partition(
      triangles.begin(), triangles.end(), [&](const HullTriangle& t) { return points.side(t[0], t[1], t[2], p) <= 0; });
  const std::vector<HullTriangle> seen(hidden, triangles.end());
  triangles.erase(hidden, triangles.end());
  std::unordered_set<std::uint64_t> edges;
  for (const HullTriangle& t : seen) {
    for (std::size_t k = 0; k < 3; ++k) edges.insert(directed(t[k], t[(k + 1) % 3]));
  }
  for (const HullTriangle& t : seen) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      if (!edges.contains(directed(to, from))) triangles.push_back({from, to, p});
    }
  }
}

}  // namespace

std::vector<HullTriangle> hull_triangles(const HullPoints& points, std::span<const int> use) {
  if (use.size() < 4) throw NoSolid("fewer than four different vertices are left");
  const auto [a, b, c, d] = first_corners(points, use);
  std::vector<HullTriangle> triangles{{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
  for (const int p : use) {
    if (p != a && p != b && p != c && p != d) add(p, points, triangles);
  }
  return triangles;
}

}  // namespace isojam
