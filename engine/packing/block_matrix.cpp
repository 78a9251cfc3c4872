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

BlockMatrix stiffened(const BlockMatrix& matrix, const std::vector<TiltStiffness>& tilts, double factor) {
  BlockMatrix sum = matrix;
  for (const TiltStiffness& tilt : tilts) {
    const Eigen::Matrix3d stiffness = factor * tilt.value;
    BlockMatrix::Block& block = sum.off_diagonal[tilt.block];
    sum.diagonal[block.row].bottomRightCorner<3, 3>() += stiffness;
    sum.diagonal[block.column].bottomRightCorner<3, 3>() += stiffness;
    block.value.bottomRightCorner<3, 3>() -= stiffness;
  }
  return sum;
}

}  // namespace isojam
