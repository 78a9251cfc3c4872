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

/// Features with which two solids touch. They are found from the intersection without a cut-off angle. Among the faces
/// that bound the intersection, take the face of A whose normal has the largest component along the contact normal, and
/// the face of B whose normal has the largest component in the opposite direction. For each of these two faces, count
/// the corners of the intersection that are on this face but not on the other one. The smaller count determines the
/// features. One corner is a vertex, or a point where two edges cross; it is a vertex if the intersection contains a
/// vertex of A or B. Two corners are the ends of an edge, and three or more are the corners of a face.
enum class ContactKind : std::uint8_t {
  vertex_face,
  edge_edge,
  edge_face,
  face_face,
  compound  ///< one of the counts is 0, or the contact is so deep that no face of one solid bounds the intersection
};
template <>
inline constexpr std::array enum_names<ContactKind>{
    EnumName{ContactKind::vertex_face, "vertex_face"}, EnumName{ContactKind::edge_edge, "edge_edge"},
    EnumName{ContactKind::edge_face, "edge_face"}, EnumName{ContactKind::face_face, "face_face"},
    EnumName{ContactKind::compound, "compound"}};

/// Force and torques that a contact exerts on its two particles, in the lab frame. F_A = −(V/2) S_A and F_B = −F_A,
/// where S_A is the vector area (Overlap::area; Smith, Fisher, Alam 2011: E_αβ = Y V²/4V_p). Lengths are in units of
/// V_p^(1/3), forces in Y·V_p^(2/3), torques in Y·V_p.
struct ContactForce {
  double volume = 0;                                  ///< volume V of the intersection, in units of V_p
  double area = 0;                                    ///< length |S_A| of the vector area, in units of V_p^(2/3)
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< unit vector S_A/|S_A|, which points out of A
  Eigen::Vector3d force_a = Eigen::Vector3d::Zero();  ///< force on A; its direction is opposite to the normal
  /// Point of application of the force: the point on the line of action that is nearest to the centroid of the
  /// intersection. It is given in the lab frame, next to the stored position of particle a and not next to one of
  /// its periodic images. About this point, the torque has only a component along the line.
  Eigen::Vector3d attack = Eigen::Vector3d::Zero();
  /// torques on A and on B, each about the centre of the particle
  Eigen::Vector3d torque_a = Eigen::Vector3d::Zero(), torque_b = Eigen::Vector3d::Zero();
  double depth = 0;                          ///< length of the shortest translation that separates the solids
  ContactKind kind = ContactKind::compound;  ///< features with which the solids touch
};

/// Finds the ContactKind of the intersection of A and B, which must have V > 0. `area` is S_A in the body frame of A.
ContactKind contact_kind(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose,
                         const QuadIntersection& intersection, const Quad3& area);

/// Computes the force of a contact in quadruple precision, from both doubles of each coordinate. The result is rounded
/// once. All members are zero if the pair does not touch. The function is slow; for many contacts, use
/// contact_forces().
ContactForce contact_force(const Packing& packing, const NeighbourPair& pair);

/// Computes contact_force() for every contact, in the order of `contacts`. Several threads share the contacts.
std::vector<ContactForce> contact_forces(const Packing& packing, std::span<const Contact> contacts);

}  // namespace isojam
