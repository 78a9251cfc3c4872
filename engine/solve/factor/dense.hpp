#pragma once

#include <Eigen/Core>
#include <memory>

namespace isojam {

// Eigen's dense decompositions, each compiled only once: including them costs half a minute of template instantiation.

/// Eigenvalues of a symmetric matrix in ascending order; reads only the lower half.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending; empty if the iteration did not converge
  Eigen::MatrixXd vectors;  ///< columns, orthonormal
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// An orthonormal basis of the span of independent columns, by Householder reflections; same number of columns.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// An orthogonal basis of the whole space whose first vectors span the given independent columns.
class CompletedBasis {
 public:
  explicit CompletedBasis(const Eigen::MatrixXd& columns);
  ~CompletedBasis();
  CompletedBasis(const CompletedBasis&) = delete;
  CompletedBasis& operator=(const CompletedBasis&) = delete;

  /// Transforms A into this basis: QᵀAQ.
  void enter(Eigen::MatrixXd& matrix) const;
  /// Transforms columns back from this basis: Q·columns.
  void leave(Eigen::MatrixXd& columns) const;

 private:
  struct Reflections;
  std::unique_ptr<const Reflections> reflections_;
};

/// R of the Householder QR of a matrix with at least as many rows as columns; size columns × columns.
Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& matrix);

/// A⁻¹ b for a positive definite A, by Cholesky factorisation.
Eigen::VectorXd solve_positive_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

struct RightSingular {
  Eigen::VectorXd values;   ///< descending, min(rows, columns)
  Eigen::MatrixXd vectors;  ///< V, columns × columns
};
RightSingular right_singular(const Eigen::MatrixXd& matrix);

/// Singular values in descending order, min(rows, columns).
Eigen::VectorXd singular_values_of(const Eigen::MatrixXd& matrix);

}  // namespace isojam
