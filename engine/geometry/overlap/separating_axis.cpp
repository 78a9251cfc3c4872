#include "engine/geometry/overlap/separating_axis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/arithmetic/lanes.hpp"

namespace isojam {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// u·v for vertex v.
double along(const SolidArrays& solid, const Eigen::Vector3d& u, int v) {
  return u.x() * solid.x[v] + u.y() * solid.y[v] + u.z() * solid.z[v];
}

/// Support function max_v u·v over a solid's vertices.
double support(const SolidArrays& solid, const Eigen::Vector3d& u) {
  double best = -infinity;
  for (int v = 0; v < solid.vertices; ++v) best = std::max(best, along(solid, u, v));
  return best;
}

Eigen::Vector3d direction(const SolidArrays& solid, int edge) {
  const int tail = solid.tail[edge], head = solid.head[edge];
  return {solid.x[head] - solid.x[tail], solid.y[head] - solid.y[tail], solid.z[head] - solid.z[tail]};
}

/// Extremes of u·v over the vertices of a placed solid, u = (x, y, z) in every lane.
struct Extent {
  Lanes x, y, z;

  Lanes along(const PlacedSolid& solid, int v) const {
    const double* p = solid.vertex_block(v / 4);
    return fma(x, Lanes::load(p), fma(y, Lanes::load(p + 4), z * Lanes::load(p + 8)));
  }
  double highest(const PlacedSolid& solid) const {
    Lanes best = along(solid, 0);
    for (int v = 4; v < solid.vertices(); v += 4) best = max(best, along(solid, v));
    return greatest(best).first();
  }
  double lowest(const PlacedSolid& solid) const {
    Lanes best = along(solid, 0);
    for (int v = 4; v < solid.vertices(); v += 4) best = min(best, along(solid, v));
    return least(best).first();
  }
};

struct Vector {
  double x, y, z;
};
inline Vector tail_to_head(const PlacedSolid& solid, const EdgeRecord& edge) {
  const double *p = solid.vertex_block(0) + edge.tail_at, *q = solid.vertex_block(0) + edge.head_at;
  return {q[0] - p[0], q[4] - p[4], q[8] - p[8]};
}

/// The axis, with x at [0], y at [4], z at [8]. Its kind is unpredictable for a branch, so all kinds are computed and
/// one is selected.
inline const double* pick_direction(const PlacedSolid& a, const PlacedSolid& b, const SeparatingAxis& axis,
                                    double* across) {
  const EdgeRecord &e = a.solid().arrays().record[axis.a], &f = b.solid().arrays().record[axis.b];
  const Vector p = tail_to_head(a, e), q = tail_to_head(b, f);
  across[0] = p.y * q.z - p.z * q.y, across[4] = p.z * q.x - p.x * q.z, across[8] = p.x * q.y - p.y * q.x;
  const double* by_kind[] = {across, a.normal_at(axis.a), b.normal_at(axis.b), across};
  return by_kind[static_cast<int>(axis.kind)];
}

/// Gap along the unit vector u (A's frame), which points from A to B. A gap that is at most `least` may be replaced by
/// `least`. The first few vertices usually show this, because each vertex can only reduce the gap, also when rounded.
double gap_along(const SolidArrays& a, const SolidArrays& b, const RelativePose& pose, const Eigen::Vector3d& u,
                 double least) {
  const Eigen::Vector3d back = -(pose.rotation.transpose() * u);
  const double centres = u.dot(pose.displacement);
  double of_a = -infinity, of_b = -infinity;
  for (int v = 0; v < std::max(a.vertices, b.vertices); ++v) {
    if (v < a.vertices) of_a = std::max(of_a, along(a, u, v));
    if (v < b.vertices) of_b = std::max(of_b, along(b, back, v));
    if (centres - of_a - of_b <= least) return least;
  }
  return centres - of_a - of_b;
}

double face_gap(const SolidArrays& face_of, const SolidArrays& other, int face, const Eigen::Matrix3d& other_to_face,
                const Eigen::Vector3d& other_centre) {
  const Eigen::Vector3d n(face_of.nx[face], face_of.ny[face], face_of.nz[face]);
  return n.dot(other_centre) - face_of.offset[face] - support(other, -(other_to_face.transpose() * n));
}

double edge_gap(const SolidArrays& a, const SolidArrays& b, const RelativePose& pose, int edge_a, int edge_b,
                double least) {
  const Eigen::Vector3d p = direction(a, edge_a);
  const Eigen::Vector3d q = pose.rotation * direction(b, edge_b);
  Eigen::Vector3d u = p.cross(q);
  const double norm = u.norm();
  // The product of parallel edges is no axis; a face normal replaces it.
  if (norm <= std::numeric_limits<double>::epsilon() * p.norm() * q.norm()) return -infinity;
  u /= u.dot(pose.displacement) < 0 ? -norm : norm;
  return gap_along(a, b, pose, u, least);
}

/// The gap along the axis; a gap that is at most `least` may be replaced by `least`.
double gap_above(double least, const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose,
                 const SeparatingAxis& axis) {
  switch (axis.kind) {
    case SeparatingAxis::Kind::none: break;
    case SeparatingAxis::Kind::face_a:
      return face_gap(a.arrays(), b.arrays(), axis.a, pose.rotation, pose.displacement);
    case SeparatingAxis::Kind::face_b:
      return face_gap(b.arrays(), a.arrays(), axis.b, pose.rotation.transpose(),
                      -(pose.rotation.transpose() * pose.displacement));
    case SeparatingAxis::Kind::edge_edge: return edge_gap(a.arrays(), b.arrays(), pose, axis.a, axis.b, least);
  }
  return -infinity;
}

}  // namespace

double gap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, const SeparatingAxis& axis) {
  return gap_above(-infinity, a, b, pose, axis);
}

SeparatingAxis best_axis(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  SeparatingAxis best;
  double widest = -infinity;
  const auto consider = [&](SeparatingAxis::Kind kind, int fa, int fb) {
    const SeparatingAxis axis{kind, static_cast<std::uint8_t>(fa), static_cast<std::uint8_t>(fb)};
    const double width = gap_above(widest, a, b, pose, axis);
    if (width > widest) widest = width, best = axis;
  };
  for (int f = 0; f < a.arrays().faces; ++f) consider(SeparatingAxis::Kind::face_a, f, 0);
  for (int f = 0; f < b.arrays().faces; ++f) consider(SeparatingAxis::Kind::face_b, 0, f);
  for (int e = 0; e < a.arrays().edges; ++e) {
    for (int f = 0; f < b.arrays().edges; ++f) consider(SeparatingAxis::Kind::edge_edge, e, f);
  }
  return best;
}

SeparatingAxis best_axis(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  const Eigen::Matrix3d to_a = a.rotation().transpose();
  return best_axis(a.solid(), b.solid(), {to_a * b.rotation(), to_a * r});
}

double gap_tolerance(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  return gap_tolerance(a, b, pose.displacement);
}

bool separates(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, const SeparatingAxis& axis) {
  if (axis.kind == SeparatingAxis::Kind::none) return false;
  alignas(32) double across[PlacedSolid::block];
  const double* u = pick_direction(a, b, axis, across);
  const double ux = u[0], uy = u[4], uz = u[8];
  const double along = ux * r.x() + uy * r.y() + uz * r.z();
  // Signs that make the axis point from A to B. The product of two edges may point either way.
  const double signs[] = {1, 1, -1, std::copysign(1.0, along)};
  const double sign = signs[static_cast<int>(axis.kind)];
  const Extent extent{Lanes::all(sign * ux), Lanes::all(sign * uy), Lanes::all(sign * uz)};
  const double gap = sign * along - extent.highest(a) + extent.lowest(b);
  const double tolerance = gap_tolerance(a.solid(), b.solid(), r);
  // u is not a unit vector; comparing squares avoids a square root and a division.
  return gap > 0 && gap * gap > tolerance * tolerance * (ux * ux + uy * uy + uz * uz);
}

}  // namespace isojam
