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

/// Features with which two solids touch. They are found from the intersection only, without a cut-off angle. Among the
/// faces that bound the intersection, take the face of A whose normal has the largest component along the contact
/// normal. Also take the face of B whose normal has the largest component in the opposite direction. For each of these
/// two faces, count the corners of the intersection that are on this face but not on the other one. The smaller of the
/// two counts determines the features. One corner means a vertex, or the point where two edges cross. Two corners mean
/// an edge, and three or more a polygon.
enum class ContactKind : std::uint8_t {
  vertex_face,
  edge_edge,
  edge_face,
  face_face,
  compound  ///< so deep that no face of one solid bounds the intersection, or that one of the counts is 0
};
template <>
inline constexpr std::array enum_names<ContactKind>{
    EnumName{ContactKind::vertex_face, "vertex_face"}, EnumName{ContactKind::edge_edge, "edge_edge"},
    EnumName{ContactKind::edge_face, "edge_face"}, EnumName{ContactKind::face_face, "face_face"},
    EnumName{ContactKind::compound, "compound"}};

/// Force and torques that a contact exerts on its two solids, in the lab frame. Lengths are in units of V_p^(1/3),
/// forces in Y·V_p^(2/3), torques in Y·V_p. F_A = −(V/2) S_A, F_B = −F_A (Smith, Fisher, Alam 2011: E_αβ = Y V²/4V_p).
struct ContactForce {
  double volume = 0;                                  ///< volume V of the intersection, in units of V_p
  double area = 0;                                    ///< length |S| of the vector area
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< unit vector S_A/|S|, which points out of A
  Eigen::Vector3d force_a = Eigen::Vector3d::Zero();  ///< force on A; its direction is opposite to the normal
  /// Point of application of the force: the point on the line of action that is nearest to the centroid of the
  /// intersection. Particle a is at its stored position. About a point on this line, the torque has only a component
  /// along the line.
  Eigen::Vector3d attack = Eigen::Vector3d::Zero();
  /// Torques on A and on B, each about the centre of the particle.
  Eigen::Vector3d torque_a = Eigen::Vector3d::Zero(), torque_b = Eigen::Vector3d::Zero();
  double depth = 0;                          ///< length of the shortest translation that separates the solids
  ContactKind kind = ContactKind::compound;  ///< features with which the solids touch
};

/// Finds the ContactKind of an intersection of A and B with V > 0. `area` is S_A in the body frame of A.
ContactKind contact_kind(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose,
                         const QuadIntersection& intersection, const Quad3& area);

/// Computes the force of a contact in quadruple precision, from both doubles of each coordinate, and rounds the result
/// once. All members are zero if the pair does not touch. The function is slow; for many contacts use contact_forces().
ContactForce contact_force(const Packing& packing, const NeighbourPair& pair);

/// Computes contact_force() of every contact, in the order of `contacts`, with several threads.
std::vector<ContactForce> contact_forces(const Packing& packing, std::span<const Contact> contacts);

}  // namespace isojam
