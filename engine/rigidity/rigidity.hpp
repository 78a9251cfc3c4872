#pragma once

#include <Eigen/Core>

#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Are the constraints independent? Maxwell and Calladine: 6N − constraints = floppy − self_stress, exactly.
struct Rigidity {
  int constraints = 0;  ///< rows; Z·N/2 from normals, C·N/2 by class
  int rank = 0;
  int self_stress = 0;  ///< states of self-stress, constraints − rank: the redundancy C·N/2 − rank
  int floppy = 0;       ///< motions that no constraint opposes, 6N − rank; 3 translations always among them
  double tolerance = 0;
  /// The least singular value of the rows that counts and the largest that does not, rows being of unit length. The
  /// rank is as certain as they are apart. 0 where there is none. The least is an estimate from above.
  double least_kept = 0, largest_dropped = 0;
  /// Orthonormal basis of the states of self-stress, constraints × self_stress; empty unless asked for.
  Eigen::MatrixXd stresses;

  bool full_rank() const { return floppy == 3; }  ///< rank 6N − 3
};

struct RigidityOptions {
  bool stresses = false;
  /// Times what the forces of the state leave unbalanced: they are a state of self-stress in the state nearest by that
  /// is in balance, and have a singular value of as much as is missing here, or less.
  double margin = 100;
};

/// States of self-stress by subspace iteration from a random start that depends on the numbers of rows alone (Halko,
/// Martinsson & Tropp 2011), with SoftRows. Singular values up to max(rows, 6N)·ε times a bound of the largest, or up
/// to `margin` times the imbalance of the forces, are zero. N = 400 takes about a second.
Rigidity analyse_rigidity(const RigidityMatrix& matrix, const RigidityOptions& options = {});

/// All singular values of the rows, descending: the oracle. Dense and slower still; for N ≤ 100.
Eigen::VectorXd singular_values(const RigidityMatrix& matrix);

}  // namespace isojam
