#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/elimination.hpp"

namespace isojam {

/// What a front takes over from a child.
struct Handover {
  int child = 0;
  std::vector<int> places;  ///< of the child's rows among this front's columns, then rows; ascending
  std::vector<int> runs;    ///< where a run of consecutive places begins, none across the end of the columns
  int runs_of_columns = 0;  ///< number of runs among the columns; these come first
};

/// One supernode: [L11; L21] in the panels of panels.hpp. L21 begins a panel of its own.
struct Front {
  Supernode node;
  std::vector<Handover> handovers;
  std::ptrdiff_t factor = 0;  ///< where the panels of L11 begin among all factors
  std::ptrdiff_t below = 0;   ///< where those of L21 begin
  std::ptrdiff_t update = 0;  ///< where −L21 L21ᵀ plus what the children handed up begins among all updates
  int panels = 0;             ///< of L21
  int first_block = 0, last_block = 0;  ///< its part of FrontPlan::blocks

  int width() const { return 6 * node.columns; }
  int rows() const { return static_cast<int>(node.rows.size()); }
  std::ptrdiff_t factor_end() const;
  std::ptrdiff_t update_size() const;
  double work() const;  ///< multiplications
  /// Where the block of a place, among the columns, then the rows, and of a column begins among all factors.
  std::ptrdiff_t at(int place, int column) const;
  /// Where the block of two rows begins among all updates.
  std::ptrdiff_t update_at(int row, int column) const;
};

/// Where an off-diagonal block of the matrix goes.
struct BlockPlace {
  int block = 0;
  std::ptrdiff_t at = 0;  ///< among all factors
  bool transposed = false;
};

/// Fronts first … last − 1, done by one thread in this order.
struct FrontRange {
  int first = 0, last = 0;
};

/// The symbolic part of a factorisation: what is done, and where the numbers lie.
struct FrontPlan {
  std::vector<int> node_of;        ///< particle at each place of the elimination order
  std::vector<Front> fronts;       ///< children before parents
  std::vector<BlockPlace> blocks;  ///< front by front
  /// What threads share out: subtrees with little work, and by themselves the fronts above these. One if it is all too
  /// little to share. Updates of ranges neither of which is below the other lie apart.
  std::vector<FrontRange> ranges;
  std::vector<int> parents;  ///< of each range, −1 for none
  std::ptrdiff_t factor_size = 0, updates_size = 0;
};

/// Plans the factorisation of a matrix; a function of its pattern alone.
FrontPlan plan_fronts(const BlockMatrix& matrix);

}  // namespace isojam
