#include "engine/solve/factor/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace isojam {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd symmetric_eigenvalues(const MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

SymmetricEigen symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  if (solver.info() != Eigen::Success) return {};
  return {solver.eigenvalues(), solver.eigenvectors()};
}

MatrixXd orthonormal(const MatrixXd& columns) {
  return Eigen::HouseholderQR<MatrixXd>(columns).householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

struct CompletedBasis::Reflections {
  explicit Reflections(const MatrixXd& columns) : qr(columns) {}
  Eigen::HouseholderQR<MatrixXd> qr;
};

CompletedBasis::CompletedBasis(const MatrixXd& columns) : reflections_(std::make_unique<const Reflections>(columns)) {}

CompletedBasis::~CompletedBasis() = default;

void CompletedBasis::enter(MatrixXd& matrix) const {
  matrix.applyOnTheLeft(reflections_->qr.householderQ().adjoint());
  matrix.applyOnTheRight(reflections_->qr.householderQ());
}

void CompletedBasis::leave(MatrixXd& columns) const { columns.applyOnTheLeft(reflections_->qr.householderQ()); }

MatrixXd triangular_factor(const MatrixXd& matrix) {
  return Eigen::HouseholderQR<MatrixXd>(matrix).matrixQR().topRows(matrix.cols()).triangularView<Eigen::Upper>();
}

VectorXd solve_positive_definite(const MatrixXd& a, const VectorXd& b) { return a.llt().solve(b); }

RightSingular right_singular(const MatrixXd& matrix) {
  const Eigen::BDCSVD<MatrixXd> svd(matrix, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

VectorXd singular_values_of(const MatrixXd& matrix) { return Eigen::BDCSVD<MatrixXd>(matrix).singularValues(); }

}  // namespace isojam
