#include "engine/solve/factor/shift_invert.hpp"

#include <stdexcept>
#include <vector>

namespace isojam {

Eigen::SparseMatrix<double> lower_half(const BlockMatrix& matrix, double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(21 * matrix.diagonal.size() + 36 * matrix.off_diagonal.size());
  for (int k = 0; k < matrix.size(); ++k) {
    for (int j = 0; j < 6; ++j) {
      for (int i = j; i < 6; ++i)
        entries.emplace_back(6 * k + i, 6 * k + j, matrix.diagonal[k](i, j) + (i == j ? shift : 0));
    }
  }
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) entries.emplace_back(6 * block.column + j, 6 * block.row + i, block.value(i, j));
    }
  }
  const int particles = 6 * matrix.size();
  for (int k = 0; k < matrix.strains(); ++k) {
    for (int i = 0; i < particles; ++i) {
      if (matrix.border(i, k) != 0) entries.emplace_back(particles + k, i, matrix.border(i, k));
    }
    for (int j = 0; j <= k; ++j)
      entries.emplace_back(particles + k, particles + j, matrix.corner(k, j) + (j == k ? shift : 0));
  }
  Eigen::SparseMatrix<double> result(matrix.rows(), matrix.rows());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

void ShiftInvert::set_shift(double sigma) {
  positive_definite_ = cholesky_.factorise(matrix_, -sigma);
  negative_pivots_ = 0;
  if (positive_definite_) return;
  ldlt_.compute(lower_half(matrix_, -sigma));
  if (ldlt_.info() != Eigen::Success || !ldlt_.vectorD().allFinite())
    throw std::domain_error("the shifted matrix is singular to working precision");
  negative_pivots_ = static_cast<int>((ldlt_.vectorD().array() < 0).count());
}

void ShiftInvert::perform_op(const double* x, double* y) const {
  const Eigen::Map<const Eigen::VectorXd> in(x, rows());
  Eigen::Map<Eigen::VectorXd> out(y, rows());
  if (positive_definite_) {
    out = cholesky_.solve(in);
  } else {
    out = ldlt_.solve(in);
  }
}

}  // namespace isojam
