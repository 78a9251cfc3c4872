#include "engine/vibration/difference_modes.hpp"

#include <utility>

#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/dynamical_matrix.hpp"

namespace isojam {

namespace {

using Eigen::MatrixXd;

/// The three translations in the coordinates of D: M^(1/2) times an equal displacement of all particles, orthonormal.
MatrixXd translations_of(const Packing& packing) {
  BlockMatrix nothing;
  nothing.diagonal.assign(packing.poses.size(), Matrix6d::Zero());
  return translations(dynamical_matrix(packing, std::move(nothing)));
}

}  // namespace

Eigen::VectorXd difference_modes(const Packing& packing, double h, Precision precision) {
  // Multiplies by M^(-1/2) from both sides; the Hessian is symmetric.
  MatrixXd matrix = mode_displacements(packing, difference_hessian(packing, h, precision));
  matrix = mode_displacements(packing, matrix.transpose());
  const MatrixXd moves = translations_of(packing);
  const MatrixXd along = matrix * moves;
  const MatrixXd among = moves.transpose() * along;
  matrix += moves * among * moves.transpose() - along * moves.transpose() - moves * along.transpose();
  return symmetric_eigenvalues(matrix);
}

}  // namespace isojam
