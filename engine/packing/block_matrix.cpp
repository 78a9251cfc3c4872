#include "engine/packing/block_matrix.hpp"

namespace isojam {

Eigen::VectorXd operator*(const BlockMatrix& matrix, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(x.size());
  for (int i = 0; i < matrix.size(); ++i) y.segment<6>(6 * i) = matrix.diagonal[i] * x.segment<6>(6 * i);
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    y.segment<6>(6 * block.row) += block.value * x.segment<6>(6 * block.column);
    y.segment<6>(6 * block.column) += block.value.transpose() * x.segment<6>(6 * block.row);
  }
  return y;
}

}  // namespace isojam
