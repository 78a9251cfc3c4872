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
  /// The least pivot that counts and the largest that does not, rows being of unit length. The rank is as certain as
  /// they are apart. 0 where there is none.
  double least_kept = 0, largest_dropped = 0;
  /// Orthonormal basis of the states of self-stress, constraints × self_stress; empty unless asked for.
  Eigen::MatrixXd stresses;

  bool full_rank() const { return floppy == 3; }  ///< rank 6N − 3
};

struct RigidityOptions {
  bool stresses = false;  ///< as many numbers again as the matrix has, at worst
  /// Times what the forces of the state leave unbalanced. The state nearest by that is in balance has a vanishing
  /// pivot; here the pivot is imbalance·|forces|/|force of the last contact eliminated|, and forces vary by about as
  /// much.
  double margin = 100;
};

/// Rank by Householder QR of rowsᵀ with column pivoting. Pivots up to max(rows, 6N)·ε times the largest, or up to
/// `margin` times the imbalance of the forces, are zero. Dense: 2400 × 2400 (N = 400) takes seconds, 50 MB.
Rigidity analyse_rigidity(const RigidityMatrix& matrix, const RigidityOptions& options = {});

/// All singular values of the rows, descending: the oracle. Dense and slower still; for N ≤ 100.
Eigen::VectorXd singular_values(const RigidityMatrix& matrix);

}  // namespace isojam
