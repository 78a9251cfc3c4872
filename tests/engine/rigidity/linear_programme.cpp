#include "tests/engine/rigidity/linear_programme.hpp"

#include <coin/ClpSimplex.hpp>
#include <coin/CoinPackedMatrix.hpp>
#include <vector>

namespace isojam {

std::optional<Eigen::VectorXd> greatest(const Eigen::SparseMatrix<double>& columns, const Eigen::VectorXd& objective) {
  const int rows = static_cast<int>(columns.rows()), unknowns = static_cast<int>(columns.cols());
  std::vector<int> row, column;
  std::vector<double> value;
  for (int k = 0; k < columns.outerSize(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(columns, k); entry; ++entry) {
      row.push_back(static_cast<int>(entry.row()));
      column.push_back(static_cast<int>(entry.col()));
      value.push_back(entry.value());
    }
    row.push_back(rows);
    column.push_back(k);
    value.push_back(1);
  }
  const CoinPackedMatrix matrix(true, row.data(), column.data(), value.data(), static_cast<CoinBigIndex>(value.size()));
  std::vector<double> zero(static_cast<std::size_t>(unknowns), 0), sums(static_cast<std::size_t>(rows) + 1, 0);
  std::vector<double> unbounded(static_cast<std::size_t>(unknowns), COIN_DBL_MAX);
  sums.back() = 1;
  ClpSimplex model;
  model.setLogLevel(0);
  model.setPrimalTolerance(1e-9);
  model.loadProblem(matrix, zero.data(), unbounded.data(), objective.data(), sums.data(), sums.data());
  model.setOptimizationDirection(-1);
  model.dual();
  if (!model.isProvenOptimal()) return std::nullopt;
  return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(model.getColSolution(), unknowns));
}

}  // namespace isojam
