#include <cmath>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

namespace {

using Vector3l = Eigen::Matrix<long double, 3, 1>;

long double golden_ratio() { return (1 + std::sqrt(5.0L)) / 2; }

void add_cube_vertices(std::vector<Vector3l>& points) {
  for (int k = 0; k < 8; ++k) points.emplace_back(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
}

/// (0, ±p, ±q) and its cyclic permutations.
void add_rectangles(std::vector<Vector3l>& points, long double p, long double q) {
  for (int k = 0; k < 4; ++k) {
    const long double y = k & 1 ? p : -p, z = k & 2 ? q : -q;
    points.emplace_back(0, y, z);
    points.emplace_back(z, 0, y);
    points.emplace_back(y, z, 0);
  }
}

std::vector<Vector3l> platonic_vertices(SolidKind kind) {
  std::vector<Vector3l> points;
  switch (kind) {
    case SolidKind::tetrahedron: points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}; break;
    case SolidKind::cube: add_cube_vertices(points); break;
    case SolidKind::octahedron:
      for (int axis = 0; axis < 3; ++axis) {
        points.push_back(Vector3l::Unit(axis));
        points.push_back(-Vector3l::Unit(axis));
      }
      break;
    case SolidKind::dodecahedron:
      add_cube_vertices(points);
      add_rectangles(points, 1 / golden_ratio(), golden_ratio());
      break;
    case SolidKind::icosahedron: add_rectangles(points, 1, golden_ratio()); break;
  }
  return points;
}

ConvexSolid make(SolidKind kind) {
  const std::vector<Vector3l> points = platonic_vertices(kind);
  return ConvexSolid(std::string(to_string(kind)), points);
}

}  // namespace

const ConvexSolid& platonic(SolidKind kind) {
  static const std::array<ConvexSolid, 5> solids{make(all_solids[0]), make(all_solids[1]), make(all_solids[2]),
                                                 make(all_solids[3]), make(all_solids[4])};
  return solids[static_cast<std::size_t>(kind)];
}

std::string_view to_string(SolidKind kind) {
  static constexpr std::array<std::string_view, 5> names{"tetrahedron", "cube", "octahedron", "dodecahedron",
                                                         "icosahedron"};
  return names[static_cast<std::size_t>(kind)];
}

std::optional<SolidKind> solid_kind(std::string_view name) {
  for (const SolidKind kind : all_solids) {
    if (to_string(kind) == name) return kind;
  }
  return std::nullopt;
}

}  // namespace isojam
