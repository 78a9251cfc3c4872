#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Rigidity matrix: the constraints that contacts impose on the 6N coordinates r = {x, R·θ}, where R is the radius of
/// gyration. A motion dr satisfies the constraints to first order if rows·dr = 0. Forces f along the constraints
/// balance if rowsᵀ·f = 0.
struct RigidityMatrix {
  Eigen::SparseMatrix<double> rows;  ///< matrix with constraints × 6N entries; every row has unit length
  /// Force of the contact along each row: (V/2)|∇V| for a normal, 0 for a tilt. The forces satisfy rowsᵀ·forces = ∇E.
  Eigen::VectorXd forces;
  /// Relative force residual |∇E| / |forces|. It is 0 if the forces are a state of self-stress, or if there are no
  /// forces.
  double imbalance = 0;
};

/// Makes the rigidity matrix with one row for each contact: the normal ∇V/|∇V|.
RigidityMatrix normal_constraints(const Packing& packing, std::span<const Contact> contacts);

/// Makes the rigidity matrix. The rows of a contact are its normal, followed by 0, 1 or 2 tilts. The class of the
/// contact determines the tilts:
///   lower order   no tilt
///   edge-face     one tilt: a relative rotation about e×n (edge × normal of the face). It lifts one end of the edge
///                 off the face. Rotations about the edge or the normal do not lift it.
///   face-face     two tilts: relative rotations about two perpendicular axes in the plane of the faces. They lift one
///                 side of a face. A rotation about the normal does not lift it.
/// The number of rows is C·N/2, where C = 3 Z_ff + 2 Z_ef + Z_l is the paper's constraint number. Throws
/// std::invalid_argument unless `alignments` and `classes` have one element per contact. It also throws this exception
/// if an alignment does not contain the faces or the edge that the class of its contact requires.
RigidityMatrix class_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments, std::span<const ContactClass> classes);

/// Indices of the underconstrained particles, ascending: a particle is underconstrained if its constraints do not
/// suppress all of its six motions even while all other particles are fixed. `particles` is N.
std::vector<int> underconstrained(const RigidityMatrix& matrix, int particles);

}  // namespace isojam
