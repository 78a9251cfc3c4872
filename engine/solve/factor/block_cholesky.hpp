#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/elimination.hpp"

namespace isojam {

/// Cholesky factorisation of H + shift·1 for a sparse symmetric matrix of 6×6 blocks, multifrontal on the graph of
/// particles (Duff & Reid 1983, Liu 1992): supernodes are eliminated as dense fronts, each handing its update matrix
/// up to its parent. The symbolic part is kept while the pattern of the matrix stays the same.
///
///   BlockCholesky factor;
///   if (factor.factorise(energy.hessian(packing), 1e-9)) step = -factor.solve(gradient);
class BlockCholesky {
 public:
  /// Factorises; false if the shifted matrix is not positive definite to working precision; then solve() must not be
  /// called.
  bool factorise(const BlockMatrix& matrix, double shift);
  /// Solution (H + shift·1)⁻¹ b, b with 6 entries per particle.
  Eigen::VectorXd solve(const Eigen::Ref<const Eigen::VectorXd>& b) const;

 private:
  /// What a front takes over from a child.
  struct Handover {
    int child = 0;
    std::vector<int> places;  ///< of the child's rows among this front's columns, then rows; ascending
    std::vector<int> runs;    ///< where a run of consecutive places begins, none across the end of the columns
  };
  /// One supernode: [L11; L21] in the panels of panels.hpp. L21 begins a panel of its own.
  struct Front {
    Supernode node;
    std::vector<Handover> handovers;
    std::ptrdiff_t factor = 0;  ///< where the panels of L11 begin in factor_
    std::ptrdiff_t below = 0;   ///< where those of L21 begin
    std::ptrdiff_t update = 0;  ///< where −L21 L21ᵀ plus what the children handed up begins in updates_
    int panels = 0;             ///< of L21

    int width() const { return 6 * node.columns; }
    std::ptrdiff_t at(int place, int column) const;
    std::ptrdiff_t update_at(int row, int column) const;
  };
  /// Where a block of the matrix goes in factor_.
  struct Target {
    std::ptrdiff_t at = 0;
    bool transposed = false;
  };

  bool has_pattern_of(const BlockMatrix& matrix) const;
  void analyse(const BlockMatrix& matrix);
  void lay_out_fronts();
  void lay_out_updates();
  void place_blocks(const BlockMatrix& matrix);
  void place_children();
  void assemble(const BlockMatrix& matrix);
  void add_shift(double shift);
  void gather_updates(const Front& front);

  std::vector<std::pair<int, int>> pattern_;
  int size_ = -1;
  std::vector<int> node_of_;   ///< particle at each place of the elimination order
  std::vector<Front> fronts_;  ///< children before parents
  std::vector<Target> diagonal_, off_diagonal_;
  Eigen::VectorXd factor_, reciprocals_, updates_;
};

}  // namespace isojam
