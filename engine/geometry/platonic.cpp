#include "engine/geometry/convex_solid.hpp"

namespace isojam {

namespace {

Quad golden_ratio() { return (1 + square_root(5)) / 2; }

void add_cube_vertices(std::vector<Quad3>& points) {
  const auto sign = [](int bit) { return Quad(bit ? 1 : -1); };
  for (int k = 0; k < 8; ++k) points.push_back({sign(k & 1), sign(k & 2), sign(k & 4)});
}

/// (0, ±p, ±q) and its cyclic permutations.
void add_rectangles(std::vector<Quad3>& points, Quad p, Quad q) {
  for (int k = 0; k < 4; ++k) {
    const Quad y = k & 1 ? p : -p, z = k & 2 ? q : -q;
    points.push_back({0, y, z});
    points.push_back({z, 0, y});
    points.push_back({y, z, 0});
  }
}

std::vector<Quad3> platonic_vertices(SolidKind kind) {
  std::vector<Quad3> points;
  switch (kind) {
    case SolidKind::tetrahedron: points = {Quad3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}; break;
    case SolidKind::cube: add_cube_vertices(points); break;
    case SolidKind::octahedron:
      for (int axis = 0; axis < 3; ++axis) {
        Quad3 unit{};
        for (const int sign : {1, -1}) {
          unit[axis] = sign;
          points.push_back(unit);
        }
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
  const std::vector<Quad3> points = platonic_vertices(kind);
  return ConvexSolid(std::string(to_string(kind)), points);
}

}  // namespace

const ConvexSolid& platonic(SolidKind kind) {
  static const std::array<ConvexSolid, 5> solids{make(all_solids[0]), make(all_solids[1]), make(all_solids[2]),
                                                 make(all_solids[3]), make(all_solids[4])};
  return solids[static_cast<std::size_t>(kind)];
}

}  // namespace isojam
