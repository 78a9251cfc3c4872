#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Inverse iteration on rows·rowsᵀ, towards the combinations of constraints with the smallest singular values, by the
/// sparse factor of rowsᵀrows + τ², 6×6 blocks on the graph of particles: with N = 400, milliseconds where a dense
/// factorisation takes half a minute.
class SoftRows {
 public:
  /// Keeps a reference to `rows`, constraints × 6N, which must outlive this. Throws std::invalid_argument if they hold
  /// what is not a number.
  explicit SoftRows(const Eigen::SparseMatrix<double>& rows);

  /// Damped x, τ² (rows rowsᵀ + τ²)⁻¹ x = x − rows (rowsᵀrows + τ²)⁻¹ rowsᵀ x (Sherman, Morrison, Woodbury), for each
  /// column: combinations with singular value σ are multiplied by τ²/(σ² + τ²), states of self-stress by one. τ is 1e-6
  /// of stiffest().
  Eigen::MatrixXd damped(const Eigen::MatrixXd& x) const;

  /// A bound for the largest singular value, the root of the largest row sum of |rowsᵀrows|.
  double stiffest() const { return stiffest_; }

 private:
  BlockCholesky factor_;
  const Eigen::SparseMatrix<double>& rows_;
  double stiffest_ = 0;
};

/// Gram matrix rowsᵀrows, of rows that are 6N long.
BlockMatrix gram(const Eigen::SparseMatrix<double>& rows);

}  // namespace isojam
