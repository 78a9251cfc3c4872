#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Inverse iteration with rows·rowsᵀ, where `rows` is RigidityMatrix::rows. It finds the combinations of constraints
/// with the smallest singular values. It uses a sparse factorisation of rowsᵀrows + τ²·1 in 6×6 blocks, one block row
/// per particle; damped() defines τ. For N = 400 this takes milliseconds; a dense factorisation would take half a
/// minute.
class SoftRows {
 public:
  /// Stores a reference to `rows`, constraints × 6N, which must outlive this object. Throws std::invalid_argument if
  /// `rows` contains NaN or infinity.
  explicit SoftRows(const Eigen::SparseMatrix<double>& rows);

  /// One step of the iteration for each column of x (Sherman, Morrison, Woodbury):
  ///   τ² (rows rowsᵀ + τ²)⁻¹ x = x − rows (rowsᵀrows + τ²)⁻¹ rowsᵀ x
  /// A combination whose singular value is σ is multiplied by τ²/(σ² + τ²). States of self-stress (σ = 0) therefore do
  /// not change, and all other combinations are damped. τ is 1e-6 times stiffest().
  Eigen::MatrixXd damped(const Eigen::MatrixXd& x) const;

  /// An upper bound of the largest singular value: the square root of the largest row sum of |rowsᵀrows|.
  double stiffest() const { return stiffest_; }

 private:
  BlockCholesky factor_;
  const Eigen::SparseMatrix<double>& rows_;
  double stiffest_ = 0;
};

/// The Gram matrix rowsᵀrows. Rows have 6N entries.
BlockMatrix gram(const Eigen::SparseMatrix<double>& rows);

}  // namespace isojam
