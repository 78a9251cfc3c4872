#include "engine/geometry/solids/named_solids.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>

#include "engine/arithmetic/elementary.hpp"
#include "engine/geometry/convex_solid.hpp"

namespace isojam {

namespace {

Quad golden_ratio() { return (1 + square_root(5)) / 2; }

Quad signed_by(int bit, Quad value) { return bit ? value : -value; }

void add_cube_vertices(std::vector<Quad3>& points) {
  for (int k = 0; k < 8; ++k) points.push_back({signed_by(k & 1, 1), signed_by(k & 2, 1), signed_by(k & 4, 1)});
}

/// (0, ±p, ±q) and its cyclic permutations.
void add_rectangles(std::vector<Quad3>& points, Quad p, Quad q) {
  for (int k = 0; k < 4; ++k) {
    const Quad y = signed_by(k & 1, p), z = signed_by(k & 2, q);
    points.push_back({0, y, z});
    points.push_back({z, 0, y});
    points.push_back({y, z, 0});
  }
}

/// (±r, 0, 0) and its permutations.
void add_axes(std::vector<Quad3>& points, Quad r) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Quad3 point{};
    for (const int sign : {1, -1}) {
      point[axis] = sign * r;
      points.push_back(point);
    }
  }
}

std::vector<Quad3> tetrahedron() { return {Quad3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}; }

std::vector<Quad3> cube() {
  std::vector<Quad3> points;
  add_cube_vertices(points);
  return points;
}

std::vector<Quad3> octahedron() {
  std::vector<Quad3> points;
  add_axes(points, 1);
  return points;
}

std::vector<Quad3> dodecahedron() {
  std::vector<Quad3> points = cube();
  add_rectangles(points, 1 / golden_ratio(), golden_ratio());
  return points;
}

std::vector<Quad3> icosahedron() {
  std::vector<Quad3> points;
  add_rectangles(points, 1, golden_ratio());
  return points;
}

/// Every edge of the tetrahedron gives two vertices, each at one third of its length from an end.
std::vector<Quad3> truncated_tetrahedron() {
  const std::vector<Quad3> whole = tetrahedron();
  std::vector<Quad3> points;
  for (const Quad3& end : whole) {
    for (const Quad3& other : whole) {
      if (end != other) points.push_back(2 * end + other);
    }
  }
  return points;
}

std::vector<Quad3> cuboctahedron() {
  std::vector<Quad3> points;
  add_rectangles(points, 1, 1);
  return points;
}

std::vector<Quad3> rhombic_dodecahedron() {
  std::vector<Quad3> points = cube();
  add_axes(points, 2);
  return points;
}

/// The permutations of (0, ±1, ±2).
std::vector<Quad3> truncated_octahedron() {
  std::vector<Quad3> points;
  add_rectangles(points, 1, 2);
  add_rectangles(points, 2, 1);
  return points;
}

/// The cuts leave √2 − 1 of each edge between them. The new edges of the cuts have the same length.
std::vector<Quad3> truncated_cube() {
  std::vector<Quad3> points;
  for (Quad3 point : cube()) {
    for (Quad& coordinate : point) {
      const Quad whole = coordinate;
      coordinate *= square_root(2) - 1;
      points.push_back(point);
      coordinate = whole;
    }
  }
  return points;
}

/// The point of the unit circle at the angle 2π k/n. Each step of Newton's method on z^n = 1 doubles the digits of the
/// guess.
std::array<Quad, 2> root_of_unity(int k, int n) {
  const double angle = 2 * std::numbers::pi * k / n;
  Quad x = nearest::cos(angle), y = nearest::sin(angle);
  for (int step = 0; step < 2; ++step) {
    Quad px = 1, py = 0;  // z^(n − 1)
    for (int power = 1; power < n; ++power) {
      const Quad next = px * x - py * y;
      py = px * y + py * x;
      px = next;
    }
    // z − (z^n − 1)/(n z^(n−1)), where 1/z^(n−1) is the conjugate of z^(n−1) because |z| = 1.
    const Quad fx = px * x - py * y - 1, fy = px * y + py * x;
    x = x - (fx * px + fy * py) / n;
    y = y - (fy * px - fx * py) / n;
  }
  return {x, y};
}

/// Vertices of a regular n-gon at a height. `turned` = 1 rotates it by half the angle between neighbours; 0 does not.
void add_polygon(std::vector<Quad3>& points, int n, int turned, Quad height) {
  for (int k = 0; k < n; ++k) {
    const auto [x, y] = root_of_unity(2 * k + turned, 2 * n);
    points.push_back({x, y, height});
  }
}

/// The edge length is 2 sin(π/n), and so is the distance between the two polygons.
std::vector<Quad3> prism(int n) {
  const Quad half = root_of_unity(1, 2 * n)[1];
  std::vector<Quad3> points;
  add_polygon(points, n, 0, -half);
  add_polygon(points, n, 0, half);
  return points;
}

/// A vertex has a horizontal distance of 2 sin(π/2n) from the nearest ones of the other polygon: h² = 4 sin²(π/n) − 4
/// sin²(π/2n).
std::vector<Quad3> antiprism(int n) {
  const Quad edge = root_of_unity(1, 2 * n)[1], beside = root_of_unity(1, 4 * n)[1];
  const Quad half = square_root(edge * edge - beside * beside);
  std::vector<Quad3> points;
  add_polygon(points, n, 0, -half);
  add_polygon(points, n, 1, half);
  return points;
}

struct Named {
  std::string_view name;
  std::vector<Quad3> (*vertices)();
};
constexpr std::array list{Named{"tetrahedron", tetrahedron},
                          Named{"cube", cube},
                          Named{"octahedron", octahedron},
                          Named{"dodecahedron", dodecahedron},
                          Named{"icosahedron", icosahedron},
                          Named{"truncated_tetrahedron", truncated_tetrahedron},
                          Named{"cuboctahedron", cuboctahedron},
                          Named{"rhombic_dodecahedron", rhombic_dodecahedron},
                          Named{"truncated_octahedron", truncated_octahedron},
                          Named{"truncated_cube", truncated_cube}};

/// A family of solids whose name ends with a number n.
struct Family {
  std::string_view name;
  int least, most;
  int left_out;  ///< n of a Platonic solid, which has another name
  std::vector<Quad3> (*vertices)(int n);
};
static_assert(ConvexSolid::max_edges / 3 == 64 && ConvexSolid::max_edges / 4 == 48, "prism_names has these numbers");
constexpr std::array families{Family{"antiprism", 4, ConvexSolid::max_edges / 4, 3, antiprism},
                              Family{"prism", 3, ConvexSolid::max_edges / 3, 4, prism}};

std::optional<std::vector<Quad3>> of_family(const Family& family, std::string_view digits) {
  int n = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
  if (error != std::errc() || end != digits.data() + digits.size() || digits.front() == '0') return std::nullopt;
  if (n < family.least || n > family.most || n == family.left_out) return std::nullopt;
  return family.vertices(n);
}

}  // namespace

std::span<const std::string_view> named_solids() {
  static constexpr auto names = [] {
    std::array<std::string_view, list.size()> all{};
    std::transform(list.begin(), list.end(), all.begin(), [](const Named& solid) { return solid.name; });
    return all;
  }();
  return names;
}

std::optional<std::vector<Quad3>> named_vertices(std::string_view name) {
  const auto* const found =
      std::find_if(list.begin(), list.end(), [&](const Named& each) { return each.name == name; });
  if (found != list.end()) return found->vertices();
  for (const Family& family : families) {
    if (name.starts_with(family.name)) return of_family(family, name.substr(family.name.size()));
  }
  return std::nullopt;
}

}  // namespace isojam
