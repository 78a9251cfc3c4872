#pragma once

#include <array>
#include <optional>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "tasks/chart/atlas/naive_clip.hpp"

namespace isojam {

/// A quaternion (w, x, y, z) of any length but 0.
using QuadQuaternion = std::array<Quad, 4>;

/// Rotation by `angle` about `axis`, which may have any length. Accurate to 1e-32 even for very small angles.
QuadQuaternion small_turn(double angle, const Eigen::Vector3d& axis);
/// Rotation by 45° about coordinate axis 0, 1 or 2.
QuadQuaternion eighth_turn(int axis);
QuadQuaternion operator*(const QuadQuaternion& p, const QuadQuaternion& q);

/// Two solids placed in double-double, to the 1e-31 that the design of a contact requires, and their exact overlap.
struct ConstructedPair {
  Pose at_a, at_b;
  VolumeAndArea reference;
  SolidKind a, b;
  bool closed_form = false;  ///< V has a closed form; S is discontinuous in some of these designs
};

/// A at the origin rotated by `turn_a`, B at r rotated by `turn_b`, then both by `common`.
struct PairDesign {
  SolidKind a = SolidKind::cube, b = SolidKind::cube;
  QuadQuaternion turn_a{1, 0, 0, 0}, turn_b{1, 0, 0, 0};
  Quad3 r{};
  QuadQuaternion common{1, 0, 0, 0};
  std::optional<double> volume;  ///< its closed form, if it has one
};

/// Values without closed form are taken from the clip in quadruple precision.
ConstructedPair constructed(const PairDesign& design);

/// Contacts of depth δ with closed forms: faces parallel, an edge on a face, an edge across another, a vertex on a
/// face.
enum class ContactShape { faces, edge_on_face, edge_across_edge, vertex_on_face };
PairDesign contact_design(ContactShape shape, double depth);

/// Octahedra tip to tip, every edge of one tip in a plane with an edge of the other.
PairDesign tip_to_tip(double depth);
/// Two cubes, faces `depth` deep and tilted by `angle`; edges likewise.
PairDesign tilted_faces(double depth, double angle);
PairDesign tilted_edges(double depth, double angle);
/// Equal orientation, B displaced by t. V has a closed form for cubes, ∏(1 − |t_c|), and for tetrahedra, whose
/// intersection is a tetrahedron: (1 + Σ min(0, n·t)/4h)³, h the inradius.
PairDesign displaced(SolidKind kind, const Eigen::Vector3d& t);

}  // namespace isojam
