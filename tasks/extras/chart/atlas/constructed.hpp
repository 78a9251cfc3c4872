#pragma once

#include <array>
#include <optional>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// A quaternion (w, x, y, z). It may have any length except 0.
using QuadQuaternion = std::array<Quad, 4>;

/// Rotation by `angle` about `axis`, which may have any length. The relative error of the angle is about 1e-16, also
/// for very small angles.
QuadQuaternion small_turn(double angle, const Eigen::Vector3d& axis);
/// Rotation by 45° about the coordinate axis 0, 1 or 2.
QuadQuaternion eighth_turn(int axis);
QuadQuaternion operator*(const QuadQuaternion& p, const QuadQuaternion& q);

/// The quantities of an overlap that the atlas compares.
struct VolumeAndArea {
  double volume = 0;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();  ///< S_A
};

/// Two solids in a designed position, and their overlap. The poses are in double-double: their error is at most 1e-31,
/// so that rounding does not destroy the designed contact.
struct ConstructedPair {
  Pose at_a, at_b;
  /// V and S_A by clipping in quadruple precision. If V has a closed form, V is computed from it instead.
  VolumeAndArea reference;
  SolidKind a, b;
  /// true if V has a closed form; S_A is then not compared, because it is discontinuous for some designs
  bool closed_form = false;
};

/// Design of a pair. A is at the origin and rotated by `turn_a`, and B is at r and rotated by `turn_b`. Then the pair
/// is rotated by `common`.
struct PairDesign {
  SolidKind a = SolidKind::cube, b = SolidKind::cube;
  QuadQuaternion turn_a{1, 0, 0, 0}, turn_b{1, 0, 0, 0};
  Quad3 r{};
  QuadQuaternion common{1, 0, 0, 0};
  std::optional<double> volume;  ///< V in closed form; nullopt if there is none
};

/// Makes the pair of a design.
ConstructedPair constructed(const PairDesign& design);

/// Contacts for which V has a closed form: two parallel faces, an edge on a face, two crossed edges, a vertex on a
/// face.
enum class ContactShape { faces, edge_on_face, edge_across_edge, vertex_on_face };
PairDesign contact_design(ContactShape shape, double depth);

/// Two octahedra that touch with one vertex each. Every edge at the vertex of A is in one plane with an edge at the
/// vertex of B.
PairDesign tip_to_tip(double depth);
/// Two cubes in contact with their faces, or with their edges. They overlap by `depth`, and the faces or edges are
/// tilted by `angle`.
PairDesign tilted_faces(double depth, double angle);
PairDesign tilted_edges(double depth, double angle);
/// Two solids with equal orientation, of which B is displaced by t. For cubes, V = ∏(1 − |t_c|). For tetrahedra, the
/// intersection is a tetrahedron with V = (1 + Σ min(0, n·t)/4h)³, where the sum is over the faces, n is the normal of
/// a face and h the inradius. For other solids there is no closed form.
PairDesign displaced(SolidKind kind, const Eigen::Vector3d& t);

}  // namespace isojam
