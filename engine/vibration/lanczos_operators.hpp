#pragma once

#include <Eigen/Core>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// Subtracts from a vector of 6N entries its components along the three translations of the whole packing.
/// `root_masses` is BlockMatrix::root_masses.
inline void remove_translations(const Eigen::VectorXd& root_masses, Eigen::Ref<Eigen::VectorXd> u) {
  if (root_masses.size() > 0) {
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < root_masses.size(); ++k) momentum += root_masses[k] * u.segment<3>(6 * k);
    momentum /= root_masses.squaredNorm();
    for (Eigen::Index k = 0; k < root_masses.size(); ++k) u.segment<3>(6 * k) -= root_masses[k] * momentum;
    return;
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < u.size(); k += 6) mean += u.segment<3>(k);
  const Eigen::Index particles = u.size() / 6;
  mean /= static_cast<double>(particles);
  for (Eigen::Index k = 0; k < u.size(); k += 6) u.segment<3>(k) -= mean;
}

/// Start vector of the Lanczos method, without components along the translations. It is the same for all matrices with
/// equal N and masses. It is random, so that it has no symmetry. From a symmetric start vector, the Lanczos method
/// finds only modes with the same symmetry.
Eigen::VectorXd lanczos_start(const BlockMatrix& matrix);

/// The operator P A P, where A is `operation` and P is the projection that removes translations. It has the interface
/// that Spectra requires. `operation` and `matrix` must outlive it.
template <class Operation>
class Deflated {
 public:
  using Scalar = double;

  Deflated(Operation& operation, const BlockMatrix& matrix) : operation_(operation), root_masses_(matrix.root_masses) {}

  Eigen::Index rows() const { return operation_.rows(); }
  Eigen::Index cols() const { return operation_.cols(); }
  void set_shift(double sigma) { operation_.set_shift(sigma); }
  void perform_op(const double* x, double* y) const {
    Eigen::VectorXd in = Eigen::Map<const Eigen::VectorXd>(x, rows());
    remove_translations(root_masses_, in);
    operation_.perform_op(in.data(), y);
    remove_translations(root_masses_, Eigen::Map<Eigen::VectorXd>(y, rows()));
  }

 private:
  Operation& operation_;
  const Eigen::VectorXd& root_masses_;
};

/// The operator x ↦ D x. `matrix` is D and must outlive it.
class Product {
 public:
  explicit Product(const BlockMatrix& matrix) : matrix_(matrix) {}

  Eigen::Index rows() const { return 6 * Eigen::Index{matrix_.size()}; }
  Eigen::Index cols() const { return rows(); }
  void set_shift(double) {}
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, rows()) = matrix_ * Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(x, rows()));
  }

 private:
  const BlockMatrix& matrix_;
};

}  // namespace isojam
