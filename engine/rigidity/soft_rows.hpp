#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Inverse iteration on rows·rowsᵀ for the combinations of constraints with the smallest singular values. It uses the
/// sparse factor of rowsᵀrows + τ², in 6×6 blocks on the graph of particles. For N = 400 this takes milliseconds; a
/// dense factorisation takes half a minute.
class SoftRows {
 public:
  /// Keeps a reference to `rows`, constraints × 6N, which must outlive this object. Throws std::invalid_argument if
  /// they contain NaN or infinity.
  explicit SoftRows(const Eigen::SparseMatrix<double>& rows);

  /// Damped x, τ² (rows rowsᵀ + τ²)⁻¹ x = x − rows (rowsᵀrows + τ²)⁻¹ rowsᵀ x (Sherman, Morrison, Woodbury), for each
  /// column. Combinations with singular value σ are multiplied by τ²/(σ² + τ²), states of self-stress by one. τ is 1e-6
  /// of stiffest().
  Eigen::MatrixXd damped(const Eigen::MatrixXd& x) const;

  /// An upper bound of the largest singular value: the root of the largest row sum of |rowsᵀrows|.
  double stiffest() const { return stiffest_; }

 private:
  BlockCholesky factor_;
  const Eigen::SparseMatrix<double>& rows_;
  double stiffest_ = 0;
};

/// Gram matrix rowsᵀrows; rows have 6N entries.
BlockMatrix gram(const Eigen::SparseMatrix<double>& rows);

}  // namespace isojam
