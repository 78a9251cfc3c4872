#include "engine/geometry/separating_axis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace isojam {

namespace {

/// Support function max_v u·v of a solid's vertices.
double support(const SolidArrays& solid, const Eigen::Vector3d& u) {
  double best = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < solid.vertices; ++k)
    best = std::max(best, u.x() * solid.x[k] + u.y() * solid.y[k] + u.z() * solid.z[k]);
  return best;
}

Eigen::Vector3d direction(const SolidArrays& solid, int edge) {
  const Edge& e = solid.edge[edge];
  return {solid.x[e.head] - solid.x[e.tail], solid.y[e.head] - solid.y[e.tail], solid.z[e.head] - solid.z[e.tail]};
}

double support(const PlacedSolid& solid, const Eigen::Vector3d& u) {
  double best = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < solid.vertices(); ++k)
    best = std::max(best, u.x() * solid.x()[k] + u.y() * solid.y()[k] + u.z() * solid.z()[k]);
  return best;
}

Eigen::Vector3d direction(const PlacedSolid& solid, int edge) {
  const Edge& e = solid.solid().arrays().edge[edge];
  return solid.vertex(e.head) - solid.vertex(e.tail);
}

/// Gap along the unit vector u (A's frame) from A to B.
double gap_along(const SolidArrays& a, const SolidArrays& b, const RelativePose& pose, const Eigen::Vector3d& u) {
  return u.dot(pose.displacement) - support(a, u) - support(b, -(pose.rotation.transpose() * u));
}

double face_gap(const SolidArrays& face_of, const SolidArrays& other, int face, const Eigen::Matrix3d& other_to_face,
                const Eigen::Vector3d& other_centre) {
  const Eigen::Vector3d n(face_of.nx[face], face_of.ny[face], face_of.nz[face]);
  return n.dot(other_centre) - face_of.offset[face] - support(other, -(other_to_face.transpose() * n));
}

double edge_gap(const SolidArrays& a, const SolidArrays& b, const RelativePose& pose, int edge_a, int edge_b) {
  const Eigen::Vector3d p = direction(a, edge_a);
  const Eigen::Vector3d q = pose.rotation * direction(b, edge_b);
  Eigen::Vector3d u = p.cross(q);
  const double norm = u.norm();
  // Parallel edges give no axis of their own: a face normal does as well.
  if (norm <= std::numeric_limits<double>::epsilon() * p.norm() * q.norm())
    return -std::numeric_limits<double>::infinity();
  u /= u.dot(pose.displacement) < 0 ? -norm : norm;
  return gap_along(a, b, pose, u);
}

}  // namespace

double gap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, const SeparatingAxis& axis) {
  switch (axis.kind) {
    case SeparatingAxis::Kind::none: break;
    case SeparatingAxis::Kind::face_a:
      return face_gap(a.arrays(), b.arrays(), axis.a, pose.rotation, pose.displacement);
    case SeparatingAxis::Kind::face_b:
      return face_gap(b.arrays(), a.arrays(), axis.b, pose.rotation.transpose(),
                      -(pose.rotation.transpose() * pose.displacement));
    case SeparatingAxis::Kind::edge_edge: return edge_gap(a.arrays(), b.arrays(), pose, axis.a, axis.b);
  }
  return -std::numeric_limits<double>::infinity();
}

SeparatingAxis best_axis(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  SeparatingAxis best;
  double widest = -std::numeric_limits<double>::infinity();
  const auto consider = [&](SeparatingAxis::Kind kind, int fa, int fb) {
    const SeparatingAxis axis{kind, static_cast<std::uint8_t>(fa), static_cast<std::uint8_t>(fb)};
    const double width = gap(a, b, pose, axis);
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
  const double tolerance = gap_tolerance(a.solid(), b.solid(), r);
  switch (axis.kind) {
    case SeparatingAxis::Kind::none: return false;
    case SeparatingAxis::Kind::face_a: {
      const Eigen::Vector3d n = a.normal(axis.a);
      return n.dot(r) - a.offset()[axis.a] - support(b, -n) > tolerance;
    }
    case SeparatingAxis::Kind::face_b: {
      const Eigen::Vector3d n = b.normal(axis.b);
      return -n.dot(r) - b.offset()[axis.b] - support(a, -n) > tolerance;
    }
    case SeparatingAxis::Kind::edge_edge: break;
  }
  Eigen::Vector3d u = direction(a, axis.a).cross(direction(b, axis.b));
  if (u.dot(r) < 0) u = -u;
  const double gap = u.dot(r) - support(a, u) - support(b, -u);
  return gap > 0 && gap * gap > tolerance * tolerance * u.squaredNorm();
}

}  // namespace isojam
