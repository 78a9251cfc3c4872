#pragma once

#include <Eigen/Core>

#include "engine/rigidity/rigidity_matrix.hpp"

namespace isojam {

/// Rank of a rigidity matrix, and the numbers that follow from it. The relation 6N − constraints = floppy − self_stress
/// is exact (Maxwell 1864, Calladine 1978).
struct Rigidity {
  /// number of rows of the matrix: Z·N/2 for normal_constraints(), C·N/2 for class_constraints()
  int constraints = 0;
  int rank = 0;          ///< rank of the matrix
  int self_stress = 0;   ///< number of states of self-stress, constraints − rank
  int floppy = 0;        ///< number of floppy motions, 6N − rank, including 3 translations
  double tolerance = 0;  ///< a singular value counts as zero if it is at most this value
  /// The smallest singular value that counts as nonzero (an upper limit, accurate to a few per cent), and the largest
  /// singular value that counts as zero. Rows have unit length. The rank is reliable if there is a large gap between
  /// the two values. `least_kept` is 0 if all singular values count as zero, and `largest_dropped` is 0 if none does.
  double least_kept = 0, largest_dropped = 0;
  /// Orthonormal basis of the states of self-stress, constraints × self_stress. Empty unless RigidityOptions::stresses
  /// is true.
  Eigen::MatrixXd stresses;
};

/// Options of analyse_rigidity().
struct RigidityOptions {
  bool stresses = false;  ///< true to compute a basis of the states of self-stress
  /// Ratio of the tolerance to the relative force residual (see RigidityMatrix), unless rounding errors require a
  /// larger tolerance. Reason: in a nearby state whose forces balance, the contact forces are a state of self-stress.
  /// In the present state, the corresponding singular value is of the order of the relative force residual, or smaller.
  double margin = 100;
  /// Largest relative force residual for which the tolerance depends on `margin`. The relative force residual of an
  /// equilibrium is below this value if MinimiseOptions::residual has its default.
  double balanced = 1e-6;
  /// Lower limit of the tolerance, for constraints whose directions are known only to this accuracy.
  double least_tolerance = 0;
};

/// Computes the rank, and a basis of the states of self-stress if it is requested. The method is inverse subspace
/// iteration with SoftRows, and the Rayleigh–Ritz method for the left singular vectors. The start is random (Halko,
/// Martinsson & Tropp 2011), but the same for every matrix of the same size. A singular value counts as zero if it is
/// at most max(rows, 6N)·ε times an upper bound of the largest singular value, where ε = 2⁻⁵². If the relative force
/// residual is at most `balanced`, a singular value also counts as zero if it is at most `margin` times this residual.
/// It also counts as zero if it is at most `least_tolerance`.
/// Throws std::invalid_argument if the rows contain NaN or infinity. The time is about a second for N = 400. If there
/// are more states of self-stress than coordinates, as in a crystal, the rank comes from all singular values, unless a
/// basis is requested.
Rigidity analyse_rigidity(const RigidityMatrix& matrix, const RigidityOptions& options = {});

}  // namespace isojam
