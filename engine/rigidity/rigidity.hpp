#pragma once

#include <Eigen/Core>

#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Rank of the constraints, whether or not they are independent: 6N − constraints = floppy − self_stress, exactly
/// (Maxwell 1864, Calladine 1978).
struct Rigidity {
  int constraints = 0;   ///< number of rows; Z·N/2 for normals, C·N/2 by class
  int rank = 0;          ///< rank of the rows
  int self_stress = 0;   ///< number of states of self-stress, constraints − rank: the redundancy C·N/2 − rank
  int floppy = 0;        ///< number of motions that no constraint opposes, 6N − rank; includes 3 translations
  double tolerance = 0;  ///< singular values up to this count as zero
  /// The smallest nonzero singular value of the rows, an upper estimate accurate to a few per cent, and the largest one
  /// that counts as zero; rows have unit length. The gap between them shows how certain the rank is. 0 if there is
  /// none.
  double least_kept = 0, largest_dropped = 0;
  /// Orthonormal basis of the states of self-stress, constraints × self_stress; empty unless requested.
  Eigen::MatrixXd stresses;

  bool full_rank() const { return floppy == 3; }  ///< true if the rank is 6N − 3
};

/// Requested results, and limits of zero.
struct RigidityOptions {
  bool stresses = false;  ///< true to compute a basis of the states of self-stress
  /// Factor of the relative force residual (RigidityMatrix) in the tolerance. A nearby balanced state has these forces
  /// as a state of self-stress, so that their singular value is at most of the order of that residual.
  double margin = 100;
  /// Largest relative force residual for which forces indicate which singular values are zero. In equilibrium it is a
  /// tenth of this or less.
  double balanced = 1e-6;
};

/// Computes the states of self-stress by inverse subspace iteration with SoftRows and the Rayleigh–Ritz method on its
/// left singular vectors. The start is random (Halko, Martinsson & Tropp 2011), but the same for every matrix of the
/// same size. Throws std::invalid_argument if the rows contain NaN or infinity. Singular values count as zero up to
/// max(rows, 6N)·ε times an upper bound of the largest one, or, if forces balance, up to `margin` times the relative
/// force residual. N = 400 takes about a second.
Rigidity analyse_rigidity(const RigidityMatrix& matrix, const RigidityOptions& options = {});

}  // namespace isojam
