#include "engine/vibration/dynamical_matrix.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace isojam {

namespace {

using Principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

/// M^(-1/2) of one particle, lab frame.
struct InverseRoot {
  double translation = 1;           ///< m^(-1/2)
  Eigen::Matrix3d rotational_root;  ///< R I^(-1/2)
};

/// R I^(-1/2) in the body frame.
Eigen::Matrix3d body_root(const ConvexSolid& solid) {
  const Principal principal(solid.inertia());
  const Eigen::Matrix3d& axes = principal.eigenvectors();
  const Eigen::Vector3d roots = solid.gyration_radius() * principal.eigenvalues().cwiseSqrt().cwiseInverse();
  return axes * roots.asDiagonal() * axes.transpose();
}

std::vector<InverseRoot> inverse_roots(const Packing& packing) {
  std::vector<InverseRoot> result;
  const ConvexSolid* solid = nullptr;
  Eigen::Matrix3d body = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    if (solid != &packing.solids[i]) body = body_root(packing.solids[i]);
    solid = &packing.solids[i];
    const Eigen::Matrix3d rotation = rotation_matrix(packing.poses[i]).high;
    result.push_back({1 / std::sqrt(solid->volume()), rotation * body * rotation.transpose()});
  }
  return result;
}

/// True if M = 1.
bool has_unit_mass(const Composition& solids) { return solids.is_uniform() && solids.only().is_spherical_top(); }

}  // namespace

BlockMatrix dynamical_matrix(const Packing& packing, BlockMatrix hessian) {
  assert(hessian.strains() == 0);
  if (has_unit_mass(packing.solids)) return hessian;
  const std::vector<InverseRoot> roots = inverse_roots(packing);
  const auto scale = [&](Matrix6d& block, int row, int column) {
    const InverseRoot &left = roots[static_cast<std::size_t>(row)], &right = roots[static_cast<std::size_t>(column)];
    block.topRows<3>() *= left.translation;
    block.leftCols<3>() *= right.translation;
    block.bottomRows<3>() = (left.rotational_root * block.bottomRows<3>()).eval();
    block.rightCols<3>() = (block.rightCols<3>() * right.rotational_root).eval();
  };
  for (int k = 0; k < hessian.size(); ++k) {
    Matrix6d& own = hessian.diagonal[static_cast<std::size_t>(k)];
    scale(own, k, k);
    own = ((own + own.transpose()) / 2).eval();  // removes the asymmetry due to rounding
  }
  for (BlockMatrix::Block& block : hessian.off_diagonal) scale(block.value, block.row, block.column);
  if (!packing.solids.is_uniform()) {
    hessian.root_masses.resize(packing.size());
    for (int k = 0; k < packing.size(); ++k)
      hessian.root_masses[k] = 1 / roots[static_cast<std::size_t>(k)].translation;
  }
  return hessian;
}

Eigen::MatrixXd mode_displacements(const Packing& packing, Eigen::MatrixXd modes) {
  if (has_unit_mass(packing.solids)) return modes;
  const std::vector<InverseRoot> roots = inverse_roots(packing);
  for (int k = 0; k < packing.size(); ++k) {
    const InverseRoot& root = roots[static_cast<std::size_t>(k)];
    modes.middleRows<3>(6 * Eigen::Index{k}) *= root.translation;
    auto rotations = modes.middleRows<3>(6 * Eigen::Index{k} + 3);
    rotations = (root.rotational_root * rotations).eval();
  }
  return modes;
}

double greatest_inverse_mass(const Packing& packing) {
  if (has_unit_mass(packing.solids)) return 1;
  double greatest = 0;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const ConvexSolid& solid = packing.solids[i];
    const double radius = solid.gyration_radius();
    greatest = std::max(greatest, radius * radius / Principal(solid.inertia()).eigenvalues()[0]);
    if (packing.solids.is_uniform()) break;
  }
  return greatest;
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

Eigen::MatrixXd translations(const BlockMatrix& matrix) {
  const int particles = matrix.size();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(6 * Eigen::Index{particles}, 3);
  const bool alike = matrix.root_masses.size() == 0;
  const double entry = 1 / (alike ? std::sqrt(static_cast<double>(particles)) : matrix.root_masses.norm());
  for (int k = 0; k < particles; ++k)
    result.block<3, 3>(6 * k, 0).diagonal().setConstant(alike ? entry : entry * matrix.root_masses[k]);
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
  if (!(h > 0)) throw std::invalid_argument("the step of differences must be positive");
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
