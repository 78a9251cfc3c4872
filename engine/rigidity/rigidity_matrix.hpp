#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Constraints due to contacts on the 6N coordinates r = {x, R·θ}, R the radius of gyration. A motion dr satisfies them
/// to first order if rows·dr = 0, and forces f along them balance if rowsᵀ·f = 0.
struct RigidityMatrix {
  Eigen::SparseMatrix<double> rows;  ///< constraints × 6N, every row of unit length
  /// Generalised force (V/2)|∇V| that the contact exerts along each row, 0 for tilts: rowsᵀ·forces = ∇E.
  Eigen::VectorXd forces;
  /// Relative force residual |∇E| / |forces|: the deviation of the forces from a state of self-stress. 0 without
  /// forces.
  double imbalance = 0;
};

/// One row per contact: ∇V/|∇V|, the motion along the contact's normal at its lever arm.
RigidityMatrix normal_constraints(const Packing& packing, std::span<const Contact> contacts);

/// Normal rows, each followed by 0, 1 or 2 tilt rows: the constraints that are geometric for each contact class.
///   lower order   no tilt.
///   edge-face     relative rotations about e×n, edge × normal of the face, lift one end of the edge off the face;
///                 rotations about the edge or the normal do not.
///   face-face     relative rotations about any axis in the plane of the faces lift one side: two axes. Rotations about
///                 the normal do not.
/// Number of rows: C·N/2, C = 3 Z_ff + 2 Z_ef + Z_l the paper's constraint number. `alignments` and `classes` have one
/// element per contact. Throws std::invalid_argument if their sizes differ, or if the alignment lacks the features of a
/// class.
RigidityMatrix class_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments, std::span<const ContactClass> classes);

}  // namespace isojam
