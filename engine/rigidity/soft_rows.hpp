#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// Tells combinations of constraints that hold nothing from those that do, by the sparse factor of rowsᵀrows + τ²,
/// 6×6 blocks on the graph of particles: with N = 400, milliseconds where a dense factorisation takes half a minute.
class SoftRows {
 public:
  /// `rows`, constraints × 6N, must outlive this.
  explicit SoftRows(const Eigen::SparseMatrix<double>& rows);

  /// x − rows (rowsᵀrows + τ²)⁻¹ rowsᵀ x = τ² (rows rowsᵀ + τ²)⁻¹ x, for each column: combinations with singular value
  /// σ are multiplied by τ²/(σ² + τ²), those that hold nothing by one. τ is 1e-6 of stiffest().
  Eigen::MatrixXd damped(const Eigen::MatrixXd& x) const;

  /// A bound for the largest singular value, the root of the largest row sum of |rowsᵀrows|.
  double stiffest() const { return stiffest_; }

 private:
  const Eigen::SparseMatrix<double>& rows_;
  BlockCholesky factor_;
  double stiffest_ = 0;
};

/// rowsᵀrows, of rows that are 6N long.
BlockMatrix gram(const Eigen::SparseMatrix<double>& rows);

}  // namespace isojam
