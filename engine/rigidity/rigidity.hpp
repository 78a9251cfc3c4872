#pragma once

#include <Eigen/Core>

#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Rank of the constraints, whether they are independent: 6N − constraints = floppy − self_stress, exactly (Maxwell
/// 1864, Calladine 1978).
struct Rigidity {
  int constraints = 0;   ///< rows; Z·N/2 from normals, C·N/2 by class
  int rank = 0;          ///< of the rows
  int self_stress = 0;   ///< states of self-stress, constraints − rank: the redundancy C·N/2 − rank
  int floppy = 0;        ///< motions that no constraint opposes, 6N − rank; 3 translations always among them
  double tolerance = 0;  ///< singular values up to this are zero
  /// The least singular value of the rows that counts, from above and right to some per cent, and the largest that
  /// does not; rows are of unit length. The rank is as certain as they are apart. 0 where there is none.
  double least_kept = 0, largest_dropped = 0;
  /// Orthonormal basis of the states of self-stress, constraints × self_stress; empty unless asked for.
  Eigen::MatrixXd stresses;

  bool full_rank() const { return floppy == 3; }  ///< rank 6N − 3
};

/// What is wanted, and what counts as zero.
struct RigidityOptions {
  bool stresses = false;  ///< whether a basis of the states of self-stress is wanted
  /// Times what the forces of the state leave unbalanced: they are a state of self-stress in the state nearest by that
  /// is in balance, and have a singular value of as much as is missing here, or less.
  double margin = 100;
  /// Forces that leave more than this unbalanced, as RigidityMatrix has it, are near no state of self-stress and say
  /// nothing of what is zero; those of packings in equilibrium leave a tenth of it and less.
  double balanced = 1e-6;
};

/// Finds the states of self-stress by inverse subspace iteration with SoftRows and the Rayleigh–Ritz method on its left
/// singular vectors, from a random start (Halko, Martinsson & Tropp 2011) that is the same for every matrix of a size.
/// Throws std::invalid_argument if the rows hold what is not a number. Singular values up to max(rows, 6N)·ε times a
/// bound of the largest, or, of forces that balance, up to `margin` times their imbalance, are zero. N = 400 takes
/// about a second.
Rigidity analyse_rigidity(const RigidityMatrix& matrix, const RigidityOptions& options = {});

}  // namespace isojam
