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

/// Features with which two solids touch, from their intersection only, without a cut-off. Among the faces that bound
/// the intersection, take the face of A whose normal has the largest component along the contact normal, and the face
/// of B with the largest component against it. Count the corners of the intersection that are on one of these faces but
/// not on the other, and take the smaller of both counts. One corner is the tip of a vertex, or the point where two
/// edges cross. Two are the ends of an edge. Three or more are a polygon.
enum class ContactKind : std::uint8_t {
  vertex_face,
  edge_edge,
  edge_face,
  face_face,
  compound  ///< so deep that one solid has no face in the contact, or the faces have no corner of their own
};
template <>
inline constexpr std::array enum_names<ContactKind>{
    EnumName{ContactKind::vertex_face, "vertex_face"}, EnumName{ContactKind::edge_edge, "edge_edge"},
    EnumName{ContactKind::edge_face, "edge_face"}, EnumName{ContactKind::face_face, "face_face"},
    EnumName{ContactKind::compound, "compound"}};

/// Force and torques of a contact on its two solids, lab frame; lengths in V_p^(1/3), forces in Y·V_p^(2/3), torques in
/// Y·V_p. F_A = −(V/2) S_A, F_B = −F_A (Smith, Fisher, Alam 2011: E_αβ = Y V²/4V_p).
struct ContactForce {
  double volume = 0;                                  ///< V of the intersection, V_p
  double area = 0;                                    ///< |S|
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< S_A/|S|, outward from A
  Eigen::Vector3d force_a = Eigen::Vector3d::Zero();  ///< force on A, opposite to the normal
  /// The point on the force's line of action that is nearest to the centroid of the intersection with particle a
  /// itself. About this line the torque has only a component along the line.
  Eigen::Vector3d attack = Eigen::Vector3d::Zero();
  /// Torques about the particles' own centres.
  Eigen::Vector3d torque_a = Eigen::Vector3d::Zero(), torque_b = Eigen::Vector3d::Zero();
  double depth = 0;                          ///< length of the shortest translation that separates the solids
  ContactKind kind = ContactKind::compound;  ///< features that touch
};

/// Kind of contact for an intersection of A and B with V > 0; `area` is S_A in A's frame.
ContactKind contact_kind(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose,
                         const QuadIntersection& intersection, const Quad3& area);

/// Force of a touching pair, computed in quadruple precision from the whole double-double state and rounded once. All
/// members are zero if the pair does not touch. Slow: see contact_forces().
ContactForce contact_force(const Packing& packing, const NeighbourPair& pair);

/// contact_force() of every contact, in their order; parallel.
std::vector<ContactForce> contact_forces(const Packing& packing, std::span<const Contact> contacts);

}  // namespace isojam
