#include "engine/packing/block_matrix.hpp"

#include <utility>

namespace isojam {

void BlockMatrix::add_pair(int row, int column, const Matrix6d& row_row, const Matrix6d& row_column,
                           const Matrix6d& column_column) {
  diagonal[row] += row_row;
  diagonal[column] += column_column;
  if (off_diagonal.empty() || off_diagonal.back().row != row || off_diagonal.back().column != column)
    off_diagonal.push_back({row, column, Matrix6d::Zero()});
  off_diagonal.back().value += row_column;
}

BlockMatrix& BlockMatrix::operator+=(const BlockMatrix& term) {
  for (std::size_t k = 0; k < diagonal.size(); ++k) diagonal[k] += term.diagonal[k];
  std::vector<Block> merged;
  const auto place = [](const Block& block) { return std::pair(block.row, block.column); };
  auto mine = off_diagonal.begin();
  for (const Block& other : term.off_diagonal) {
    for (; mine != off_diagonal.end() && place(*mine) < place(other); ++mine) merged.push_back(*mine);
    merged.push_back(other);
    if (mine != off_diagonal.end() && place(*mine) == place(other)) merged.back().value += (mine++)->value;
  }
  merged.insert(merged.end(), mine, off_diagonal.end());
  off_diagonal = std::move(merged);
  border += term.border;
  corner += term.corner;
  return *this;
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
