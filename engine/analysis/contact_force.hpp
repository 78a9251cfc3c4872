#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// What two solids touch with, told from their intersection alone, without a cut-off. Of all faces that bound it, take
/// the one of A that is turned most along the contact normal and the one of B that is turned most against it, and count
/// the corners that the intersection has on either of them and not on the other, the fewer of both: one is the tip of a
/// vertex, or the point where two edges cross; two are the ends of an edge; three and more a polygon.
enum class ContactKind : std::uint8_t {
  vertex_face,
  edge_edge,
  edge_face,
  face_face,
  compound  ///< so deep that one of them has no face there, or the two faces no corner of their own
};
template <>
inline constexpr std::array enum_names<ContactKind>{
    EnumName{ContactKind::vertex_face, "vertex_face"}, EnumName{ContactKind::edge_edge, "edge_edge"},
    EnumName{ContactKind::edge_face, "edge_face"}, EnumName{ContactKind::face_face, "face_face"},
    EnumName{ContactKind::compound, "compound"}};

/// What a contact does to its two solids, lab frame; lengths in V_p^(1/3), forces in Y·V_p^(2/3), torques in Y·V_p.
/// F_A = −(V/2) S_A, F_B = −F_A (Smith, Fisher, Alam 2011: E_αβ = Y V²/4V_p).
struct ContactForce {
  double volume = 0;                                  ///< V of the intersection, V_p
  double area = 0;                                    ///< |S|
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< S_A/|S|, out of A
  Eigen::Vector3d force_a = Eigen::Vector3d::Zero();  ///< on A, against the normal
  /// On the line along which the force acts (all of its torque but for the part along itself), nearest the centroid of
  /// the intersection with particle a itself.
  Eigen::Vector3d attack = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_a = Eigen::Vector3d::Zero(), torque_b = Eigen::Vector3d::Zero();  ///< about own centres
  double depth = 0;                          ///< length of the shortest translation that parts them
  ContactKind kind = ContactKind::compound;  ///< what touches
};

/// Of an intersection of A and B that has a volume, with S_A for its `area`, in A's frame.
ContactKind contact_kind(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose,
                         const QuadIntersection& intersection, const Quad3& area);

/// Force of a touching pair, reckoned in quadruple precision from the whole double-double state and rounded once. All
/// zero if they turn out not to touch. Slow: see contact_forces().
ContactForce contact_force(const Packing& packing, const NeighbourPair& pair);

/// contact_force() of every contact, in their order, parallel.
std::vector<ContactForce> contact_forces(const Packing& packing, std::span<const Contact> contacts);

}  // namespace isojam
