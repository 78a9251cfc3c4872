#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/elimination.hpp"

namespace isojam {

/// Describes how the update matrix of a child front is added to its parent front.
struct Handover {
  int child = 0;
  /// positions of the rows of the child in the list of columns, followed by rows, of the parent; ascending
  std::vector<int> places;
  std::vector<int> runs;    ///< first elements of runs of consecutive positions; no run crosses the end of the columns
  int runs_of_columns = 0;  ///< number of runs in the columns; these runs come first
};

/// A front: the dense factor [L11; L21] of one supernode, stored in the panels of panels.hpp. L21 begins with a new
/// panel.
struct Front {
  Supernode node;
  std::vector<Handover> handovers;
  std::ptrdiff_t factor = 0;  ///< index of the first panel of L11 in the array of all factors
  std::ptrdiff_t below = 0;   ///< index of the first panel of L21 in the array of all factors
  /// index of the update matrix, −L21 L21ᵀ plus the updates of the children, in the array of all updates
  std::ptrdiff_t update = 0;
  int panels = 0;                       ///< number of panels of L21
  int first_block = 0, last_block = 0;  ///< range of the blocks of this front in FrontPlan::blocks

  int width() const { return 6 * node.columns; }
  int rows() const { return static_cast<int>(node.rows.size()); }
  std::ptrdiff_t factor_end() const;
  std::ptrdiff_t update_size() const;
  double work() const;  ///< number of multiplications
  /// Index in the array of all factors of the block at a position (columns, then rows) and a column.
  std::ptrdiff_t at(int place, int column) const;
  /// Index in the array of all updates of the block of two rows.
  std::ptrdiff_t update_at(int row, int column) const;
};

/// Position of an off-diagonal block of the matrix in the fronts.
struct BlockPlace {
  int block = 0;
  std::ptrdiff_t at = 0;  ///< index in the array of all factors
  bool transposed = false;
};

/// The fronts first … last − 1, which one thread processes in this order.
struct FrontRange {
  int first = 0, last = 0;
};

/// The symbolic factorisation: the sequence of operations, and the layout of the memory.
struct FrontPlan {
  std::vector<int> node_of;        ///< particle at each position of the elimination order
  std::vector<Front> fronts;       ///< children before parents
  std::vector<BlockPlace> blocks;  ///< front by front
  /// Units of work for threads: subtrees with little work, and the single fronts above them. There is only one unit if
  /// the total work is too small for several threads. If two ranges are in different branches of the tree, their
  /// updates do not overlap in memory.
  std::vector<FrontRange> ranges;
  std::vector<int> parents;  ///< index of the parent of each range, −1 if it has none
  std::ptrdiff_t factor_size = 0, updates_size = 0;
};

/// Computes the symbolic factorisation of a matrix. The result depends only on the pattern of the matrix.
FrontPlan plan_fronts(const BlockMatrix& matrix);

}  // namespace isojam
