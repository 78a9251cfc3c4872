#include "engine/vibration/dynamical_matrix.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "engine/solve/factor/shift_invert.hpp"

namespace isojam {

namespace {

using Principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

/// R I^(-1/2) of every particle, lab frame: what M^(-1/2) is for R·θ.
std::vector<Eigen::Matrix3d> inverse_roots(const Packing& packing) {
  const Principal principal(packing.solid->inertia());
  const Eigen::Matrix3d& axes = principal.eigenvectors();
  const Eigen::Vector3d roots = packing.solid->gyration_radius() * principal.eigenvalues().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d body = axes * roots.asDiagonal() * axes.transpose();
  std::vector<Eigen::Matrix3d> result;
  for (const Pose& pose : packing.poses) {
    const Eigen::Matrix3d rotation = rotation_matrix(pose).high;
    result.emplace_back(rotation * body * rotation.transpose());
  }
  return result;
}

}  // namespace

BlockMatrix dynamical_matrix(const Packing& packing, BlockMatrix hessian) {
  assert(hessian.strains() == 0);
  if (packing.solid->is_spherical_top()) return hessian;
  const std::vector<Eigen::Matrix3d> roots = inverse_roots(packing);
  const auto scale = [&](Matrix6d& block, int row, int column) {
    block.bottomRows<3>() = (roots[static_cast<std::size_t>(row)] * block.bottomRows<3>()).eval();
    block.rightCols<3>() = (block.rightCols<3>() * roots[static_cast<std::size_t>(column)]).eval();
  };
  for (int k = 0; k < hessian.size(); ++k) {
    Matrix6d& own = hessian.diagonal[static_cast<std::size_t>(k)];
    scale(own, k, k);
    own = ((own + own.transpose()) / 2).eval();  // what rounding took of its symmetry
  }
  for (BlockMatrix::Block& block : hessian.off_diagonal) scale(block.value, block.row, block.column);
  return hessian;
}

Eigen::MatrixXd mode_displacements(const Packing& packing, Eigen::MatrixXd modes) {
  if (packing.solid->is_spherical_top()) return modes;
  const std::vector<Eigen::Matrix3d> roots = inverse_roots(packing);
  for (int k = 0; k < packing.size(); ++k) {
    auto turns = modes.middleRows<3>(6 * Eigen::Index{k} + 3);
    turns = (roots[static_cast<std::size_t>(k)] * turns).eval();
  }
  return modes;
}

double greatest_inverse_mass(const Packing& packing) {
  const ConvexSolid& solid = *packing.solid;
  if (solid.is_spherical_top()) return 1;
  const double radius = solid.gyration_radius();
  return radius * radius / Principal(solid.inertia()).eigenvalues()[0];
}

Eigen::SparseMatrix<double> sparse_matrix(const BlockMatrix& matrix) {
  return lower_half(matrix, 0).selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd dense_matrix(const BlockMatrix& matrix) {
  const Eigen::Index n = 6 * Eigen::Index{matrix.size()}, strains = matrix.strains();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n + strains, n + strains);
  for (int k = 0; k < matrix.size(); ++k) dense.block<6, 6>(6 * k, 6 * k) = matrix.diagonal[k];
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    dense.block<6, 6>(6 * block.row, 6 * block.column) = block.value;
    dense.block<6, 6>(6 * block.column, 6 * block.row) = block.value.transpose();
  }
  if (strains > 0) {
    dense.topRightCorner(n, strains) = matrix.border;
    dense.bottomLeftCorner(strains, n) = matrix.border.transpose();
    dense.bottomRightCorner(strains, strains) = matrix.corner;
  }
  return dense;
}

Eigen::MatrixXd translations(int particles) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(6 * Eigen::Index{particles}, 3);
  const double entry = 1 / std::sqrt(static_cast<double>(particles));
  for (int k = 0; k < particles; ++k) result.block<3, 3>(6 * k, 0).diagonal().setConstant(entry);
  return result;
}

double norm_bound(const BlockMatrix& matrix) {
  const Eigen::Index n = 6 * Eigen::Index{matrix.size()}, strains = matrix.strains();
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n + strains);
  for (int k = 0; k < matrix.size(); ++k) sums.segment<6>(6 * k) = matrix.diagonal[k].cwiseAbs().rowwise().sum();
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    sums.segment<6>(6 * block.row) += block.value.cwiseAbs().rowwise().sum();
    sums.segment<6>(6 * block.column) += block.value.cwiseAbs().colwise().sum().transpose();
  }
  if (strains > 0) {
    sums.head(n) += matrix.border.cwiseAbs().rowwise().sum();
    sums.tail(strains) =
        matrix.border.cwiseAbs().colwise().sum().transpose() + matrix.corner.cwiseAbs().rowwise().sum();
  }
  if (!sums.allFinite()) return std::numeric_limits<double>::infinity();
  return sums.size() == 0 ? 0 : sums.maxCoeff();
}

double rounding_bound(const BlockMatrix& matrix, double lambda_max) {
  std::vector<int> blocks(matrix.diagonal.size(), 1);
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    ++blocks[block.row];
    ++blocks[block.column];
  }
  const int most = blocks.empty() ? 0 : *std::max_element(blocks.begin(), blocks.end());
  return std::numeric_limits<double>::epsilon() * std::sqrt(6.0 * matrix.size()) * most * lambda_max;
}

Eigen::MatrixXd difference_hessian(const Packing& packing, double h, Precision precision) {
  if (!(h > 0)) throw std::invalid_argument("differences need a step");
  PackingEnergy energy;
  const Eigen::Index n = 6 * Eigen::Index{packing.size()};
  Eigen::MatrixXd slopes(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(n, k);
    slopes.col(k) = (energy.evaluate(moved(packing, step), precision).gradient -
                     energy.evaluate(moved(packing, -step), precision).gradient) /
                    (2 * h);
  }
  return (slopes + slopes.transpose()) / 2;
}

}  // namespace isojam
