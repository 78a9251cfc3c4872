#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/elimination.hpp"

namespace isojam {

/// The part of a child's update matrix that a front adds to its own.
struct Handover {
  int child = 0;
  std::vector<int> places;  ///< places of the child's rows among this front's columns, then rows; ascending
  std::vector<int> runs;    ///< beginnings of runs of consecutive places; no run crosses the end of the columns
  int runs_of_columns = 0;  ///< number of runs among the columns; they come first
};

/// One supernode: [L11; L21] in the panels of panels.hpp. L21 begins a new panel.
struct Front {
  Supernode node;
  std::vector<Handover> handovers;
  std::ptrdiff_t factor = 0;  ///< beginning of the panels of L11 in the array of all factors
  std::ptrdiff_t below = 0;   ///< beginning of the panels of L21
  std::ptrdiff_t update = 0;  ///< beginning of −L21 L21ᵀ plus the children's updates in the array of all updates
  int panels = 0;             ///< number of panels of L21
  int first_block = 0, last_block = 0;  ///< range in FrontPlan::blocks

  int width() const { return 6 * node.columns; }
  int rows() const { return static_cast<int>(node.rows.size()); }
  std::ptrdiff_t factor_end() const;
  std::ptrdiff_t update_size() const;
  double work() const;  ///< number of multiplications
  /// Beginning of the block of a place (columns, then rows) and a column in the array of all factors.
  std::ptrdiff_t at(int place, int column) const;
  /// Beginning of the block of two rows in the array of all updates.
  std::ptrdiff_t update_at(int row, int column) const;
};

/// Destination of an off-diagonal block of the matrix.
struct BlockPlace {
  int block = 0;
  std::ptrdiff_t at = 0;  ///< index in the array of all factors
  bool transposed = false;
};

/// Fronts first … last − 1, which one thread handles in this order.
struct FrontRange {
  int first = 0, last = 0;
};

/// The symbolic part of a factorisation: the operations, and the memory layout.
struct FrontPlan {
  std::vector<int> node_of;        ///< particle at each position of the elimination order
  std::vector<Front> fronts;       ///< children before parents
  std::vector<BlockPlace> blocks;  ///< front by front
  /// Units of work for threads: subtrees with little work, and the single fronts above them. One unit if the total work
  /// is too small to share. If neither of two ranges is below the other one, their updates do not overlap in memory.
  std::vector<FrontRange> ranges;
  std::vector<int> parents;  ///< parent of each range, −1 for none
  std::ptrdiff_t factor_size = 0, updates_size = 0;
};

/// Plans the factorisation of a matrix; the result depends only on its pattern.
FrontPlan plan_fronts(const BlockMatrix& matrix);

}  // namespace isojam
