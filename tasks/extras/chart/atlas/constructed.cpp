#include "tasks/extras/chart/atlas/constructed.hpp"

#include <algorithm>
#include <cmath>

#include "engine/geometry/overlap/clipped_overlap.hpp"

namespace isojam {

namespace {

Quad3 vector_part(const QuadQuaternion& q) { return {q[1], q[2], q[3]}; }

/// x rotated by the unit quaternion q.
Quad3 turned(const QuadQuaternion& q, const Quad3& x) {
  const Quad3 t = Quad(2) * cross(vector_part(q), x);
  return x + q[0] * t + cross(vector_part(q), t);
}

QuadQuaternion normalised(QuadQuaternion q) {
  const Quad length = square_root(q[0] * q[0] + dot(vector_part(q), vector_part(q)));
  for (Quad& component : q) component = component / length;
  return q;
}

Pose pose_of(const Quad3& position, const QuadQuaternion& q) {
  Pose pose;
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble x = narrowed(position[c]), u = narrowed(q[c + 1]);
    pose.position[c] = x.high, pose.position_low[c] = x.low;
    pose.orientation.coeffs()[c] = u.high, pose.orientation_low[c] = u.low;
  }
  const DoubleDouble w = narrowed(q[0]);
  pose.orientation.coeffs()[3] = w.high, pose.orientation_low[3] = w.low;
  return pose;
}

/// Exact volume of the overlap that displaced() constructs; nullopt for solids without a formula.
std::optional<double> displaced_volume(SolidKind kind, const Eigen::Vector3d& t) {
  if (kind == SolidKind::cube) return (1 - t.cwiseAbs().array()).prod();
  if (kind != SolidKind::tetrahedron) return std::nullopt;
  double sum = 0;
  for (const Face& face : platonic(kind).faces()) sum += std::min(0.0, face.normal.dot(t)) / (4 * face.offset);
  return std::pow(1 + sum, 3);
}

}  // namespace

QuadQuaternion small_turn(double angle, const Eigen::Vector3d& axis) {
  // An exact tangent in quadruple precision would change only the last digits of the angle.
  const Quad tangent = std::tan(angle / 2);
  const Eigen::Vector3d u = axis.normalized();
  return {1, tangent * Quad(u.x()), tangent * Quad(u.y()), tangent * Quad(u.z())};
}

QuadQuaternion eighth_turn(int axis) {
  QuadQuaternion q{1 + square_root(2), 0, 0, 0};
  q[static_cast<std::size_t>(axis) + 1] = 1;
  return q;
}

QuadQuaternion operator*(const QuadQuaternion& p, const QuadQuaternion& q) {
  const Quad3 u = vector_part(p), v = vector_part(q);
  const Quad3 w = p[0] * v + q[0] * u + cross(u, v);
  return {p[0] * q[0] - dot(u, v), w[0], w[1], w[2]};
}

ConstructedPair constructed(const PairDesign& design) {
  const QuadQuaternion common = normalised(design.common);
  ConstructedPair pair{{}, {}, {}, design.a, design.b, design.volume.has_value()};
  pair.at_a = pose_of({}, normalised(common * design.turn_a));
  pair.at_b = pose_of(turned(common, design.r), normalised(common * design.turn_b));
  const QuadPose pose = relative_pose(pair.at_a, pair.at_b, quad_position(pair.at_b));
  const QuadOverlap exact = clipped_overlap(platonic(pair.a), platonic(pair.b), pose);
  pair.reference.volume = design.volume.value_or(static_cast<double>(exact.volume));
  pair.reference.area = rounded(quad_rotation(pair.at_a) * exact.area);
  return pair;
}

PairDesign contact_design(ContactShape shape, double depth) {
  const Quad half = Quad(1) / 2, diagonal = square_root(half), deep = depth;
  PairDesign design;
  switch (shape) {
    case ContactShape::faces:
      design.r = {1 - deep, 0.25, 0.125};
      design.volume = 0.75 * 0.875 * depth;
      break;
    case ContactShape::edge_on_face:
      design.turn_b = eighth_turn(2);
      design.r = {half + diagonal - deep, 0.125, 0.25};
      design.volume = 0.75 * depth * depth;
      break;
    case ContactShape::edge_across_edge:
      design.turn_a = eighth_turn(2);
      design.turn_b = eighth_turn(1);
      design.r = {2 * diagonal - deep, 0.125, 0.0625};
      design.volume = 2.0 / 3 * std::pow(depth, 3);
      break;
    case ContactShape::vertex_on_face:
      design.b = SolidKind::octahedron;
      design.r = {half + norm(platonic(design.b).arrays().vertex(0)) - deep, 0.125, 0.0625};
      design.volume = 2.0 / 3 * std::pow(depth, 3);
      break;
  }
  return design;
}

PairDesign tip_to_tip(double depth) {
  PairDesign design;
  design.a = design.b = SolidKind::octahedron;
  design.r = {2 * norm(platonic(design.a).arrays().vertex(0)) - Quad(depth), 0, 0};
  design.volume = std::pow(depth, 3) / 6;
  return design;
}

PairDesign tilted_faces(double depth, double angle) {
  PairDesign design = contact_design(ContactShape::faces, depth);
  design.turn_b = small_turn(angle, {0, 0.8, 0.6});
  if (angle != 0) design.volume.reset();
  return design;
}

PairDesign tilted_edges(double depth, double angle) {
  PairDesign design;
  design.turn_a = eighth_turn(2);
  design.turn_b = small_turn(angle, {1, 0, 0}) * eighth_turn(2);
  design.r = {square_root(2) - Quad(depth), 0, 0.25};
  if (angle == 0) design.volume = 0.75 * depth * depth / 2;
  return design;
}

PairDesign displaced(SolidKind kind, const Eigen::Vector3d& t) {
  PairDesign design;
  design.a = design.b = kind;
  design.r = {t.x(), t.y(), t.z()};
  design.volume = displaced_volume(kind, t);
  return design;
}

}  // namespace isojam
