#include "engine/rigidity/rigidity.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <limits>

namespace isojam {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using PivotedQr = Eigen::ColPivHouseholderQR<MatrixXd>;

/// From rowsᵀ P = Q [R₁ R₂; 0 0]: the columns of P [−R₁⁻¹R₂; 1], made orthonormal.
MatrixXd stress_basis(const PivotedQr& qr, Index constraints, Index rank) {
  const Index states = constraints - rank;
  if (states == 0) return MatrixXd(constraints, 0);
  MatrixXd null = MatrixXd::Identity(constraints, constraints).rightCols(states);
  null.topRows(rank) = -qr.matrixR().topRightCorner(rank, states);
  qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(null.topRows(rank));
  const MatrixXd in_order = qr.colsPermutation() * null;
  return Eigen::HouseholderQR<MatrixXd>(in_order).householderQ() * MatrixXd::Identity(constraints, states);
}

}  // namespace

Rigidity analyse_rigidity(const RigidityMatrix& matrix, const RigidityOptions& options) {
  const Index constraints = matrix.rows.rows(), coordinates = matrix.rows.cols();
  Rigidity result;
  result.constraints = static_cast<int>(constraints);
  result.floppy = static_cast<int>(coordinates);
  if (constraints == 0) return result;
  const PivotedQr qr(MatrixXd(matrix.rows.transpose()));
  const Eigen::VectorXd pivots = qr.matrixQR().diagonal().cwiseAbs();
  const double rounding =
      static_cast<double>(std::max(constraints, coordinates)) * std::numeric_limits<double>::epsilon();
  result.tolerance = std::max(rounding * pivots.maxCoeff(), options.margin * matrix.imbalance);
  // Pivots fall but for rounding; the first that is zero ends the rank.
  Index rank = 0;
  while (rank < pivots.size() && pivots[rank] > result.tolerance) ++rank;
  result.rank = static_cast<int>(rank);
  result.self_stress = static_cast<int>(constraints - rank);
  result.floppy = static_cast<int>(coordinates - rank);
  if (rank > 0) result.least_kept = pivots[rank - 1];
  if (rank < pivots.size()) result.largest_dropped = pivots.tail(pivots.size() - rank).maxCoeff();
  if (options.stresses) result.stresses = stress_basis(qr, constraints, rank);
  return result;
}

Eigen::VectorXd singular_values(const RigidityMatrix& matrix) {
  if (matrix.rows.rows() == 0) return {};
  return Eigen::BDCSVD<MatrixXd>(MatrixXd(matrix.rows)).singularValues();
}

}  // namespace isojam
