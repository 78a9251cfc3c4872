#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Constraints that contacts put on the 6N coordinates r = {x, R·θ}, R the radius of gyration: to first order a motion
/// dr keeps them where rows·dr = 0, and forces f along them balance where rowsᵀ·f = 0.
struct RigidityMatrix {
  Eigen::SparseMatrix<double> rows;  ///< constraints × 6N, every row of unit length
  /// Generalised force (V/2)|∇V| of each row, which the contact exerts along it, 0 for tilts: rowsᵀ·forces = ∇E.
  Eigen::VectorXd forces;
  /// |∇E| / |forces|: how far the forces are from a state of self-stress. 0 without forces.
  double imbalance = 0;
};

/// One row per contact: ∇V/|∇V|, the motion along the contact's normal at its lever.
RigidityMatrix normal_constraints(const Packing& packing, std::span<const Contact> contacts);

/// Normal rows, with 0, 1 or 2 rows of tilt below each: what a contact of each class opposes as a matter of shape.
///   lower order   nothing else.
///   edge-face     relative turns about e×n, edge × normal of the face, lift one end of the edge off the face; turns
///                 about the edge or the normal do not.
///   face-face     relative turns about any axis in the plane of the faces lift one side: two axes. Turns about the
///                 normal do not.
/// Rows in all: C·N/2, C = 3 Z_ff + 2 Z_ef + Z_l the paper's constraint number. `alignments` and `classes` per contact.
/// Throws std::invalid_argument if their numbers differ, or a class names features that the alignment has not found.
RigidityMatrix class_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments, std::span<const ContactClass> classes);

}  // namespace isojam
