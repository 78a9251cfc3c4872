#pragma once

#include <cstddef>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/elimination.hpp"

namespace isojam {

/// Describes how the update matrix of a child front is added to its parent front. A place is the index of a particle in
/// a front: places 0 … columns − 1 are the columns of the supernode, and the places that follow are its rows.
struct Handover {
  int child = 0;
  /// for each row of the child, its place in the parent; ascending
  std::vector<int> places;
  /// indices in `places` at which runs of consecutive places begin; a run contains only columns or only rows of the
  /// parent
  std::vector<int> runs;
  int runs_of_columns = 0;  ///< number of runs that contain columns; these runs come first
};

/// A front: the dense factor [L11; L21] of one supernode. Its columns are the columns of the supernode. The rows of L11
/// are the same particles, and the rows of L21 are the rows of the supernode. Both matrices are stored in panels
/// (panels.hpp); L21 begins with a new panel.
struct Front {
  Supernode node;
  std::vector<Handover> handovers;
  std::ptrdiff_t factor = 0;  ///< index at which L11 begins in the array of all factors
  std::ptrdiff_t below = 0;   ///< index at which L21 begins in the array of all factors
  /// Index at which the update matrix begins in the array of all updates. The update matrix is −L21 L21ᵀ plus the
  /// update matrices of the children, as far as they belong to rows of this front.
  std::ptrdiff_t update = 0;
  int panels = 0;                       ///< number of panels of L21
  int first_block = 0, last_block = 0;  ///< range of the blocks of this front in FrontPlan::blocks

  int width() const { return 6 * node.columns; }
  int rows() const { return static_cast<int>(node.rows.size()); }
  std::ptrdiff_t factor_end() const;
  std::ptrdiff_t update_size() const;
  double work() const;  ///< number of multiplications for the front
  /// Index at which a 6×6 block of the factor begins in the array of all factors. The row of the block is given as a
  /// place, see Handover.
  std::ptrdiff_t at(int place, int column) const;
  /// Index at which a 6×6 block of the update matrix begins in the array of all updates. `row` and `column` are indices
  /// of Supernode::rows.
  std::ptrdiff_t update_at(int row, int column) const;
};

/// Position at which an off-diagonal block of the matrix is stored in the array of all factors.
struct BlockPlace {
  int block = 0;            ///< index of the block in BlockMatrix::off_diagonal
  std::ptrdiff_t at = 0;    ///< index in the array of all factors
  bool transposed = false;  ///< true if the transpose of the block is stored there
};

/// A range of fronts, first … last − 1. One thread processes them in this order.
struct FrontRange {
  int first = 0, last = 0;
};

/// The symbolic factorisation: the sequence of operations, and the layout of the memory.
struct FrontPlan {
  std::vector<int> node_of;        ///< particle at each position of the elimination order
  std::vector<Front> fronts;       ///< children before parents
  std::vector<BlockPlace> blocks;  ///< sorted by their front
  /// Units of work for threads: subtrees with little work, and single fronts above these subtrees. There is only one
  /// range if the total work is too small for several threads. Ranges in different branches of the tree use separate
  /// memory for their updates.
  std::vector<FrontRange> ranges;
  std::vector<int> parents;  ///< index of the parent range of each range, or −1 if it has none
  std::ptrdiff_t factor_size = 0, updates_size = 0;
};

/// Computes the symbolic factorisation of a matrix. The result depends only on the pattern of the matrix.
FrontPlan plan_fronts(const BlockMatrix& matrix);

}  // namespace isojam
