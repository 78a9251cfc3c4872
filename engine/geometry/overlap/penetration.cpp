#include "engine/geometry/overlap/penetration.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace isojam {

namespace {

/// Largest n·v over the vertices.
Quad support(const ConvexSolid& solid, const Quad3& n) {
  Quad most = dot(n, solid.arrays().vertex(0));
  for (int v = 1; v < solid.arrays().vertices; ++v) most = std::max(most, dot(n, solid.arrays().vertex(v)));
  return most;
}

Quad3 edge_vector(const ConvexSolid& solid, int edge) {
  const Edge& e = solid.edges()[static_cast<std::size_t>(edge)];
  return solid.arrays().vertex(e.head) - solid.arrays().vertex(e.tail);
}

/// Direction of the axis from A to B, in A's frame, not normalised.
Quad3 direction_of(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose, const SeparatingAxis& axis) {
  if (axis.kind == SeparatingAxis::Kind::face_a) return a.arrays().normal(axis.a);
  if (axis.kind == SeparatingAxis::Kind::face_b) return Quad(-1) * (pose.rotation * b.arrays().normal(axis.b));
  const Quad3 across = cross(edge_vector(a, axis.a), pose.rotation * edge_vector(b, axis.b));
  return dot(across, pose.displacement) < 0 ? Quad(-1) * across : across;
}

Quad depth_along(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose, const SeparatingAxis& axis) {
  const Quad3 n = direction_of(a, b, pose, axis);
  const Quad3 back = Quad(-1) * (transposed(pose.rotation) * n);
  return (support(a, n) + support(b, back) - dot(n, pose.displacement)) / norm(n);
}

/// Calls visit(axis) for every candidate axis.
template <class Visit>
void for_each_axis(const ConvexSolid& a, const ConvexSolid& b, const Visit& visit) {
  using Kind = SeparatingAxis::Kind;
  const auto axis = [](Kind kind, int of_a, int of_b) {
    return SeparatingAxis{kind, static_cast<std::uint8_t>(of_a), static_cast<std::uint8_t>(of_b)};
  };
  for (int f = 0; f < a.arrays().faces; ++f) visit(axis(Kind::face_a, f, 0));
  for (int f = 0; f < b.arrays().faces; ++f) visit(axis(Kind::face_b, 0, f));
  for (int e = 0; e < a.arrays().edges; ++e) {
    for (int f = 0; f < b.arrays().edges; ++f) visit(axis(Kind::edge_edge, e, f));
  }
}

}  // namespace

Penetration penetration(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose) {
  const RelativePose rough = narrowed(pose);
  std::vector<std::pair<double, SeparatingAxis>> gaps;
  double widest = -std::numeric_limits<double>::infinity();
  for_each_axis(a, b, [&](const SeparatingAxis& axis) {
    gaps.emplace_back(gap(a, b, rough, axis), axis);
    widest = std::max(widest, gaps.back().first);
  });
  const double tie = 2 * gap_tolerance(a, b, rough);
  Penetration least;
  for (const auto& [width, axis] : gaps) {
    if (width < widest - tie) continue;
    const Quad depth = depth_along(a, b, pose, axis);
    if (least.axis.kind == SeparatingAxis::Kind::none || depth < least.depth) least = {axis, depth};
  }
  return least;
}

}  // namespace isojam
