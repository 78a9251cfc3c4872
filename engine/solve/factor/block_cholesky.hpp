#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/fronts.hpp"
#include "engine/solve/factor/panels.hpp"

namespace isojam {

/// Cholesky factorisation of H + shift·1 for a sparse symmetric matrix H of 6×6 blocks, by the multifrontal method on
/// the graph of particles (Duff & Reid 1983, Liu 1992). Each supernode is eliminated as a dense front, and passes its
/// update matrix to the parent front. For large matrices, several threads process different fronts, and different rows
/// of the largest fronts. The result has the same bits for any number of threads. The symbolic factorisation is reused
/// until the pattern of the matrix changes. If the matrix has a border of strains, the strains are eliminated last.
/// This needs one solution of the linear system for each strain, and a Cholesky factorisation of the Schur complement.
///
///   BlockCholesky factor;
///   if (factor.factorise(energy.hessian(packing), 1e-9)) step = -factor.solve(gradient);
class BlockCholesky {
 public:
  /// Factorises the matrix. Returns false if the shifted matrix is not positive definite in double precision. solve()
  /// may be called only after factorise() has returned true.
  bool factorise(const BlockMatrix& matrix, double shift);
  /// The solution (H + shift·1)⁻¹ b. b must have matrix.rows() entries.
  Eigen::VectorXd solve(const Eigen::Ref<const Eigen::VectorXd>& b) const;

 private:
  bool factorise_blocks(const BlockMatrix& matrix, double shift);
  bool factorise_border(const BlockMatrix& matrix, double shift);
  Eigen::VectorXd solve_blocks(const Eigen::Ref<const Eigen::VectorXd>& b) const;
  bool has_pattern_of(const BlockMatrix& matrix) const;
  void analyse(const BlockMatrix& matrix);
  bool eliminate(const Front& front, const BlockMatrix& matrix, double shift);
  void assemble(const Front& front, const BlockMatrix& matrix, double shift, panels::Threads threads);
  void gather_columns(const Front& front, panels::Threads threads);
  void gather_update(const Front& front, panels::Threads threads);
  void take_over(const Front& front, const Handover& handover, int row, int first, int last);

  std::vector<std::pair<int, int>> pattern_;
  int size_ = -1;
  FrontPlan plan_;
  Eigen::VectorXd factor_, reciprocals_, updates_;
  Eigen::MatrixXd response_;  ///< −(H + shift·1)⁻¹·border
  Eigen::LLT<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>> complement_;
};

}  // namespace isojam
