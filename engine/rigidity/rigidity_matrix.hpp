#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Rigidity matrix: the constraints that contacts impose on the 6N coordinates r = {x, R·θ}, where R is the radius of
/// gyration. A motion dr satisfies the constraints to first order if rows·dr = 0. Forces f along the constraints
/// balance if rowsᵀ·f = 0.
struct RigidityMatrix {
  Eigen::SparseMatrix<double> rows;  ///< matrix with constraints × 6N entries; every row has unit length
  /// Generalised force (V/2)|∇V| of the contact along each row, 0 for tilts. They satisfy rowsᵀ·forces = ∇E.
  Eigen::VectorXd forces;
  /// Relative force residual |∇E| / |forces|. It is 0 if the forces are a state of self-stress, and also if there are
  /// no forces.
  double imbalance = 0;
};

/// Makes the rigidity matrix with one row ∇V/|∇V| per contact, the normal.
RigidityMatrix normal_constraints(const Packing& packing, std::span<const Contact> contacts);

/// Makes the rigidity matrix with the normal of each contact, followed by 0, 1 or 2 tilts according to the class of the
/// contact:
///   lower order   no tilt.
///   edge-face     one tilt: a relative rotation about e×n (edge × normal of the face) lifts one end of the edge off
///                 the face. Rotations about the edge or the normal do not.
///   face-face     two tilts: a relative rotation about any axis in the plane of the faces lifts one side. A
///                 rotation about the normal does not.
/// The number of rows is C·N/2, where C = 3 Z_ff + 2 Z_ef + Z_l is the paper's constraint number. `alignments` and
/// `classes` must have one element per contact. Throws std::invalid_argument if their sizes differ, or if an alignment
/// lacks the features that the class of its contact requires.
RigidityMatrix class_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments, std::span<const ContactClass> classes);

}  // namespace isojam
