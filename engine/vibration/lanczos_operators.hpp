#pragma once

#include <Eigen/Core>

#include "engine/packing/block_matrix.hpp"

namespace isojam {

/// Projects the three translations of the packing as a whole out of a vector of 6N entries.
inline void remove_translations(Eigen::Ref<Eigen::VectorXd> u) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < u.size(); k += 6) mean += u.segment<3>(k);
  const Eigen::Index particles = u.size() / 6;
  mean /= static_cast<double>(particles);
  for (Eigen::Index k = 0; k < u.size(); k += 6) u.segment<3>(k) -= mean;
}

/// Start vector of Lanczos, the same for every matrix of 6N rows, without symmetry that could hide a mode from it.
Eigen::VectorXd lanczos_start(Eigen::Index rows);

/// Operator P op P, P the projector that removes translations: the form in which Spectra takes an operator. It must
/// outlive this.
template <class Operation>
class Deflated {
 public:
  using Scalar = double;

  explicit Deflated(Operation& operation) : operation_(operation) {}

  Eigen::Index rows() const { return operation_.rows(); }
  Eigen::Index cols() const { return operation_.cols(); }
  void set_shift(double sigma) { operation_.set_shift(sigma); }
  void perform_op(const double* x, double* y) const {
    Eigen::VectorXd in = Eigen::Map<const Eigen::VectorXd>(x, rows());
    remove_translations(in);
    operation_.perform_op(in.data(), y);
    remove_translations(Eigen::Map<Eigen::VectorXd>(y, rows()));
  }

 private:
  Operation& operation_;
};

/// Operator x ↦ D x; D must outlive it.
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
