#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// Cholesky factorisation of H + shift·1 for a sparse symmetric matrix of 6×6 blocks, multifrontal on the graph of
/// particles: approximate minimum degree on the particles, dense fronts over supernodes. The symbolic part is kept
/// while the pattern of the matrix stays the same.
///
///   BlockCholesky factor;
///   if (factor.factorise(energy.hessian(packing), 1e-9)) step = -factor.solve(gradient);
class BlockCholesky {
 public:
  /// False if the shifted matrix is not positive definite to working precision; then solve() must not be called.
  bool factorise(const BlockMatrix& matrix, double shift);
  /// (H + shift·1)⁻¹ b, b with 6 entries per particle.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  /// Columns first … first + columns − 1 of the permuted matrix, eliminated together; `rows` are the later columns
  /// that they couple to (in blocks, ascending).
  struct Front {
    int first = 0, columns = 0;
    std::vector<int> rows;
    std::vector<int> children;
    std::vector<std::vector<int>> child_places;  ///< per child, place in this front of each of the child's rows
    std::vector<std::pair<int, int>> entries;    ///< (off-diagonal block index, place of its row in the front)
    std::vector<int> entry_column;               ///< column of the front for each entry
    std::vector<char> entry_transposed;
    Eigen::MatrixXd factor;  ///< [L11; L21], 6·(columns + rows) × 6·columns
    Eigen::MatrixXd update;  ///< 6·rows square, lower half: −L21 L21ᵀ and what the children handed up
  };

  void analyse(const BlockMatrix& matrix);
  void build_fronts(const std::vector<std::vector<int>>& structure, const std::vector<int>& parent);
  void place_entries(const BlockMatrix& matrix);
  void place_children();
  void assemble(Front& front, const BlockMatrix& matrix, double shift);

  std::vector<std::pair<int, int>> pattern_;
  int size_ = -1;
  std::vector<int> node_of_;   ///< particle of each permuted column
  std::vector<int> place_of_;  ///< permuted column of each particle
  std::vector<Front> fronts_;  ///< children before parents
};

}  // namespace isojam
