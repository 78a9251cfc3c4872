#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/analysis/contact_force.hpp"
#include "engine/analysis/contacts.hpp"
#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Where a contact can push: the corners of the polygon in which two faces meet, the ends of the piece of an edge that
/// lies in a face, or one point. Its force is one-sided: a sum of pushes f_k ≥ 0 at these, all along the normal.
struct ContactPatch {
  /// In A's body frame, V_p^(1/3); three or more in order around the polygon, two, or one.
  std::vector<Eigen::Vector3d> corners;
  /// How far inside the patch the contact's force acts: for a polygon its distance to the nearest side over the root of
  /// the area, for an edge that to the nearer end over its length (½ in the middle), both seen along the normal; −1
  /// stands for all below; 1 for a point. A positive margin means that the force is a sum of positive pushes at all
  /// corners, so that every small change of it in force and torque is one too.
  double margin = 1;
};

/// The patch of every contact, as its class says: the polygon of the face of A that gives θ_ff, the piece of the edge
/// of θ_ef inside the other body, the point of attack. One element each per contact, else std::invalid_argument.
std::vector<ContactPatch> contact_patches(const Packing& packing, std::span<const Contact> contacts,
                                          std::span<const ContactForce> forces, std::span<const Alignment> alignments,
                                          std::span<const ContactClass> classes);

/// A row of unit length for the push at each corner of each patch: ∇V of the contact, which is what its force acts
/// along, and the couple that takes it from where it acts to the corner. f ≥ 0 with rowsᵀ·f = 0 are the states of
/// self-stress that contacts can bear. `forces` of the matrix are left at 0.
RigidityMatrix corner_constraints(const Packing& packing, std::span<const Contact> contacts,
                                  std::span<const ContactForce> forces, std::span<const ContactPatch> patches);

/// The states of self-stress that one-sided contacts can bear, as forces and torques of contacts: a cone.
struct OneSidedStresses {
  /// Dimension of the cone, all multiples of one state counting as one. Where all margins are positive it is that of
  /// all self-stress, one-sided or not, since the state's own forces lie inside: constraints by class less their rank.
  int dimension = 0;
  int constraints = 0;       ///< C·N/2
  int outside = 0;           ///< contacts without a positive margin; the dimension holds only if there are none
  int outside_faces = 0;     ///< of these, face-face ones
  double least_margin = 1;   ///< of all contacts that are not points
  double median_margin = 1;  ///< of the same
};
/// Of contacts with their forces, angles and classes, one of each; else std::invalid_argument.
OneSidedStresses one_sided_stresses(const Packing& packing, std::span<const Contact> contacts,
                                    std::span<const ContactForce> forces, std::span<const Alignment> alignments,
                                    std::span<const ContactClass> classes);

}  // namespace isojam
