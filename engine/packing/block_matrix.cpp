#include "engine/packing/block_matrix.hpp"

namespace isojam {

void BlockMatrix::add_pair(int row, int column, const Matrix6d& row_row, const Matrix6d& row_column,
                           const Matrix6d& column_column) {
  diagonal[row] += row_row;
  diagonal[column] += column_column;
  if (off_diagonal.empty() || off_diagonal.back().row != row || off_diagonal.back().column != column)
    off_diagonal.push_back({row, column, Matrix6d::Zero()});
  off_diagonal.back().value += row_column;
}

Eigen::VectorXd operator*(const BlockMatrix& matrix, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(x.size());
  for (int i = 0; i < matrix.size(); ++i) y.segment<6>(6 * i) = matrix.diagonal[i] * x.segment<6>(6 * i);
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    y.segment<6>(6 * block.row) += block.value * x.segment<6>(6 * block.column);
    y.segment<6>(6 * block.column) += block.value.transpose() * x.segment<6>(6 * block.row);
  }
  if (matrix.strains() > 0) {
    const Eigen::Index n = 6 * Eigen::Index{matrix.size()}, k = matrix.strains();
    y.head(n) += matrix.border * x.tail(k);
    y.tail(k) = matrix.border.transpose() * x.head(n) + matrix.corner * x.tail(k);
  }
  return y;
}

}  // namespace isojam
