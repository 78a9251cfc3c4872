#include "engine/vibration/pinned_matrix.hpp"

#include <vector>

namespace isojam {

BlockMatrix pinned_matrix(const BlockMatrix& matrix, double pinned_diagonal, Pinning pinning) {
  BlockMatrix pinned = matrix;
  if (matrix.size() == 0) return pinned;
  Matrix6d& first = pinned.diagonal[0];
  first.topRows<3>().setZero();
  first.leftCols<3>().setZero();
  first.topLeftCorner<3, 3>().diagonal().setConstant(pinned_diagonal);
  if (matrix.strains() > 0) pinned.border.topRows<3>().setZero();
  std::vector<char> touched(matrix.diagonal.size(), 0);
  for (BlockMatrix::Block& block : pinned.off_diagonal) {
    if (block.row == 0) block.value.topRows<3>().setZero();
    if (block.column == 0) block.value.leftCols<3>().setZero();
    touched[block.row] = touched[block.column] = 1;
  }
  if (pinning == Pinning::translations) return pinned;
  for (int k = 0; k < matrix.size(); ++k) {
    if (!touched[k]) pinned.diagonal[k] = pinned_diagonal * Matrix6d::Identity();
  }
  return pinned;
}

}  // namespace isojam
