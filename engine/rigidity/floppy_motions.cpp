#include "engine/rigidity/floppy_motions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <limits>

#include "engine/packing/energy.hpp"
#include "engine/vibration/dynamical_matrix.hpp"

namespace isojam {

namespace {

/// Orthonormal basis of what all rows and the translations leave.
Eigen::MatrixXd null_space(const RigidityMatrix& normals, const BlockMatrix& hessian) {
  const Eigen::Index n = normals.rows.cols();
  Eigen::MatrixXd taken(n, normals.rows.rows() + 3);
  taken << Eigen::MatrixXd(normals.rows).transpose(), translations(hessian);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(taken);
  // A state of self-stress leaves the imbalance of its forces for a pivot.
  qr.setThreshold(std::max(100 * normals.imbalance, static_cast<double>(n) * std::numeric_limits<double>::epsilon()));
  const Eigen::Index rank = qr.rank();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, n - rank);
  basis.bottomRows(n - rank).setIdentity();
  basis.applyOnTheLeft(qr.householderQ());
  return basis;
}

double largest_motion(const Eigen::Ref<const Eigen::VectorXd>& u) {
  double largest = 0;
  for (Eigen::Index i = 0; i < u.size(); i += 6) largest = std::max(largest, u.segment<6>(i).norm());
  return largest;
}

}  // namespace

FloppyMotions floppy_motions(const RigidityMatrix& normals, const BlockMatrix& hessian) {
  FloppyMotions motions;
  const Eigen::MatrixXd basis = null_space(normals, hessian);
  if (basis.cols() == 0) {
    motions.vectors.resize(basis.rows(), 0);
    return motions;
  }
  const Eigen::MatrixXd among = basis.transpose() * sparse_matrix(hessian) * basis;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver((among + among.transpose()) / 2);
  motions.stiffness = solver.eigenvalues();
  motions.vectors = basis * solver.eigenvectors();
  for (Eigen::Index k = 0; k < motions.vectors.cols(); ++k)
    motions.vectors.col(k) /= largest_motion(motions.vectors.col(k));
  return motions;
}

EnergyAlong energy_along(const Packing& packing, const Eigen::MatrixXd& motions, std::span<const double> amplitudes) {
  PackingEnergy energy;
  const auto at_rest = energy.evaluate(packing, Precision::double_double);
  EnergyAlong along;
  along.noise = 2 * at_rest.energy_noise + 64 * std::numeric_limits<double>::epsilon() * at_rest.energy;
  along.rise.resize(motions.cols(), static_cast<Eigen::Index>(amplitudes.size()));
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    for (std::size_t j = 0; j < amplitudes.size(); ++j) {
      const Eigen::VectorXd step = amplitudes[j] * motions.col(k);
      const double up = energy.evaluate(moved(packing, step), Precision::double_double).energy;
      const double down = energy.evaluate(moved(packing, -step), Precision::double_double).energy;
      along.rise(k, static_cast<Eigen::Index>(j)) = (up - at_rest.energy) / 2 + (down - at_rest.energy) / 2;
    }
  }
  return along;
}

}  // namespace isojam
