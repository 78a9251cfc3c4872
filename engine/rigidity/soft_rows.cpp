#include "engine/rigidity/soft_rows.hpp"

#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

namespace isojam {
namespace {

using Eigen::Index;
using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The entries of a row, six for each of its particles.
std::map<int, Vector6d> by_particle(const RowMajor& rows, Index row) {
  std::map<int, Vector6d> parts;
  for (RowMajor::InnerIterator entry(rows, row); entry; ++entry) {
    const auto [part, first] = parts.try_emplace(static_cast<int>(entry.col() / 6), Vector6d::Zero());
    part->second[entry.col() % 6] = entry.value();
  }
  return parts;
}

double largest_row_sum(const BlockMatrix& matrix) {
  Eigen::VectorXd sums(6 * matrix.size());
  for (int i = 0; i < matrix.size(); ++i)
    sums.segment<6>(6 * i) = matrix.diagonal[static_cast<std::size_t>(i)].cwiseAbs().rowwise().sum();
  for (const auto& block : matrix.off_diagonal) {
    sums.segment<6>(6 * block.row) += block.value.cwiseAbs().rowwise().sum();
    sums.segment<6>(6 * block.column) += block.value.cwiseAbs().colwise().sum().transpose();
  }
  return sums.maxCoeff();
}

}  // namespace

BlockMatrix gram(const Eigen::SparseMatrix<double>& rows) {
  assert(rows.cols() % 6 == 0);
  BlockMatrix matrix;
  matrix.diagonal.assign(static_cast<std::size_t>(rows.cols() / 6), Matrix6d::Zero());
  std::map<std::pair<int, int>, Matrix6d> pairs;
  const RowMajor in_rows = rows;
  for (Index row = 0; row < in_rows.rows(); ++row) {
    const auto parts = by_particle(in_rows, row);
    for (auto a = parts.begin(); a != parts.end(); ++a) {
      matrix.diagonal[static_cast<std::size_t>(a->first)] += a->second * a->second.transpose();
      for (auto b = std::next(a); b != parts.end(); ++b)
        pairs.try_emplace({a->first, b->first}, Matrix6d::Zero()).first->second += a->second * b->second.transpose();
    }
  }
  for (const auto& [pair, value] : pairs) matrix.off_diagonal.push_back({pair.first, pair.second, value});
  return matrix;
}

SoftRows::SoftRows(const Eigen::SparseMatrix<double>& rows) : rows_(rows) {
  const BlockMatrix matrix = gram(rows);
  const double scale = largest_row_sum(matrix);
  stiffest_ = std::sqrt(scale);
  // Rounding errors are 1e-16 of the scale. They can make a singular matrix indefinite by a few times this, but not by
  // 1e-12.
  if (!std::isfinite(scale) || !factor_.factorise(matrix, 1e-12 * scale))
    throw std::invalid_argument("constraints that are not finite have no rank");
}

Eigen::MatrixXd SoftRows::damped(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd result = x;
  for (Index k = 0; k < x.cols(); ++k) {
    const Eigen::VectorXd image = rows_.transpose() * x.col(k);
    result.col(k) -= rows_ * factor_.solve(image);
  }
  return result;
}

}  // namespace isojam
