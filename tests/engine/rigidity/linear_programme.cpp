#include "tests/engine/rigidity/linear_programme.hpp"

#include <coin/ClpSimplex.hpp>
#include <coin/CoinPackedMatrix.hpp>
#include <vector>

namespace isojam {

LinearProgramme::LinearProgramme(const Eigen::SparseMatrix<double>& columns, double tolerance)
    : model_(std::make_unique<ClpSimplex>()) {
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
  model_->setLogLevel(0);
  model_->setPrimalTolerance(tolerance);
  model_->loadProblem(matrix, zero.data(), unbounded.data(), zero.data(), sums.data(), sums.data());
  model_->setOptimizationDirection(-1);
  // Columns are of unit length as they are; scaled ones would be off by another tolerance.
  model_->scaling(0);
}

LinearProgramme::~LinearProgramme() = default;

Optimum LinearProgramme::greatest(const Eigen::VectorXd& objective) {
  for (int k = 0; k < model_->numberColumns(); ++k) model_->setObjectiveCoefficient(k, objective[k]);
  // Where the last one ended is feasible for another objective.
  if (begun_) {
    model_->primal();
  } else {
    model_->dual();
  }
  if (model_->isProvenPrimalInfeasible()) return {Optimum::End::infeasible, {}};
  if (!model_->isProvenOptimal()) return {};
  begun_ = true;
  return {Optimum::End::found, Eigen::Map<const Eigen::VectorXd>(model_->getColSolution(), model_->numberColumns())};
}

}  // namespace isojam
