#include "engine/geometry/hull_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

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
/// The same in double-double: the error of each of the six products is below 26 · 2⁻¹⁰⁶.
constexpr double fine_determinant_error = 0x1p-98;

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
    fine_.push_back(narrowed(point));
  }
}

int HullPoints::side(int a, int b, int c, int p) const {
  const Vector3d& o = near(a);
  const double coarse = determinant<Vector3d>(near(b) - o, near(c) - o, near(p) - o);
  if (std::abs(coarse) > determinant_error * std::numeric_limits<double>::epsilon()) return sign(coarse);
  const HullPoints& points = *this;
  for (std::size_t k = 0; k < 3; ++k) {
    // Many solids have faces in planes of constant x, y or z.
    if (points[b][k] == points[a][k] && points[c][k] == points[a][k] && points[p][k] == points[a][k]) return 0;
  }
  const auto fine_difference = [this](int q, int r) {
    const DoubleDouble3 &x = fine(q), &y = fine(r);
    return DoubleDouble3{x[0] - y[0], x[1] - y[1], x[2] - y[2]};
  };
  const double better = determinant(fine_difference(b, a), fine_difference(c, a), fine_difference(p, a)).high;
  if (std::abs(better) > fine_determinant_error) return sign(better);
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

/// A hull that grows by one point at a time. Every point outside the hull is in the list of one triangle that it sees.
class GrowingHull {
 public:
  GrowingHull(const HullPoints& points, std::span<const int> use) : points_(points) {
    const auto [a, b, c, d] = first_corners(points, use);
    facets_ = {{{a, b, c}, {1, 2, 3}}, {{a, d, b}, {3, 2, 0}}, {{b, d, c}, {1, 3, 0}}, {{c, d, a}, {2, 1, 0}}};
    distribute(use, 0);
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (facets_[f].is_on_hull && !facets_[f].seen_by.empty()) add(farthest_above(f), f);
    }
  }

  std::vector<HullTriangle> triangles() const {
    std::vector<HullTriangle> all;
    for (const Facet& facet : facets_) {
      if (facet.is_on_hull) all.push_back(facet.corners);
    }
    return all;
  }

 private:
  struct Facet {
    HullTriangle corners;
    std::array<std::size_t, 3> next;  ///< the facets beyond the edges that begin at each corner
    std::vector<int> seen_by{};
    bool is_on_hull = true;
  };

  bool sees(int p, const Facet& f) const { return points_.side(f.corners[0], f.corners[1], f.corners[2], p) > 0; }

  /// Assigns each point to the first facet from `first` on that it sees. Points inside the hull are omitted.
  void distribute(std::span<const int> points, std::size_t first) {
    for (const int p : points) {
      const auto seen = std::find_if(facets_.begin() + static_cast<std::ptrdiff_t>(first), facets_.end(),
                                     [&](const Facet& facet) { return sees(p, facet); });
      if (seen != facets_.end()) seen->seen_by.push_back(p);
    }
  }

  int farthest_above(std::size_t f) const {
    const auto [a, b, c] = facets_[f].corners;
    const Vector3d normal = (points_.near(b) - points_.near(a)).cross(points_.near(c) - points_.near(a));
    return *std::max_element(facets_[f].seen_by.begin(), facets_[f].seen_by.end(),
                             [&](int p, int q) { return normal.dot(points_.near(p)) < normal.dot(points_.near(q)); });
  }

  /// Replaces the facets that the point sees, of which f is one, by triangles from their outline to the point.
  void add(int p, std::size_t f) {
    const std::size_t first = facets_.size();
    std::unordered_map<int, std::size_t> from;  // the new facet whose edge of the outline begins at a corner
    std::vector<int> others;
    std::vector<std::size_t> seen{f};
    facets_[f].is_on_hull = false;
    while (!seen.empty()) {
      const Facet facet = std::move(facets_[seen.back()]);
      facets_[seen.back()].is_on_hull = false;
      const std::size_t here = seen.back();
      seen.pop_back();
      others.insert(others.end(), facet.seen_by.begin(), facet.seen_by.end());
      for (std::size_t k = 0; k < 3; ++k) {
        Facet& beyond = facets_[facet.next[k]];
        if (!beyond.is_on_hull) continue;
        if (sees(p, beyond)) {
          beyond.is_on_hull = false;
          seen.push_back(facet.next[k]);
          continue;
        }
        *std::find(beyond.next.begin(), beyond.next.end(), here) = facets_.size();
        from[facet.corners[k]] = facets_.size();
        facets_.push_back({{facet.corners[k], facet.corners[(k + 1) % 3], p}, {facet.next[k], 0, 0}});
      }
    }
    for (std::size_t k = first; k < facets_.size(); ++k) {
      const std::size_t following = from.at(facets_[k].corners[1]);
      facets_[k].next[1] = following;
      facets_[following].next[2] = k;
    }
    std::erase(others, p);
    distribute(others, first);
  }

  const HullPoints& points_;
  std::vector<Facet> facets_;
};

}  // namespace

std::vector<HullTriangle> hull_triangles(const HullPoints& points, std::span<const int> use) {
  if (use.size() < 4) throw NoSolid("fewer than four different vertices are left");
  return GrowingHull(points, use).triangles();
}

}  // namespace isojam
