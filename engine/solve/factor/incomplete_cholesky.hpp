#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// Incomplete block Cholesky factorisation IC(0) of H + shift·1 for a sparse symmetric matrix H of 6×6 blocks: the
/// factor has no block where H has none (Meijerink & van der Vorst 1977). It serves as a preconditioner. Its cost is
/// proportional to the number of blocks. The blocks are factorised in double precision and stored in single precision.
/// All sums have a fixed order, so the bits do not depend on the number of threads. If the matrix has a border of
/// strains, the preconditioner neglects the coupling of strains and particles.
class IncompleteCholesky {
 public:
  /// Factorises the matrix. Returns false if a pivot block is not positive definite. This can happen even if H +
  /// shift·1 is positive definite; a larger shift then helps. solve() may be called only after factorise() has returned
  /// true.
  bool factorise(const BlockMatrix& matrix, double shift);
  /// The approximate solution of (H + shift·1) x = b. b must have matrix.rows() entries.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  static constexpr int rows = 6, padded_rows = 8;
  /// A 6×6 block by columns. Each column is padded by two zeros, so that it is one vector of eight lanes.
  using SingleBlock = Eigen::Matrix<float, padded_rows, rows>;

  bool eliminate(int k);

  std::vector<int> begin_, columns_;      ///< block row k has the blocks begin_[k] … begin_[k + 1] − 1
  std::vector<Matrix6d> pivots_, upper_;  ///< blocks during the factorisation
  /// inverse_[k] = L_kk⁻¹ and upper_single_[b] = L_kk⁻¹ A_kj, and their transposes.
  std::vector<SingleBlock> inverse_, inverse_transposed_, upper_single_, upper_transposed_;
  Eigen::LLT<Eigen::MatrixXd> corner_;
};

}  // namespace isojam
