#pragma once

#include <Eigen/Core>
#include <memory>

namespace isojam {

// Dense decompositions of Eigen. Only dense.cpp includes their headers, because these take half a minute to compile.

/// Computes the eigenvalues of a symmetric matrix in ascending order. Reads only the lower half of the matrix.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< eigenvalues in ascending order; empty if the iteration did not converge
  Eigen::MatrixXd vectors;  ///< orthonormal eigenvectors, as columns
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// Computes an orthonormal basis of the space that linearly independent columns span, by Householder reflections. The
/// basis has as many columns as the argument.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// An orthonormal basis Q of the whole space. Its first vectors span the same space as the given linearly independent
/// columns.
class CompletedBasis {
 public:
  explicit CompletedBasis(const Eigen::MatrixXd& columns);
  ~CompletedBasis();
  CompletedBasis(const CompletedBasis&) = delete;
  CompletedBasis& operator=(const CompletedBasis&) = delete;

  /// Transforms a matrix A into this basis: QᵀAQ.
  void enter(Eigen::MatrixXd& matrix) const;
  /// Transforms columns back from this basis: Q·columns.
  void leave(Eigen::MatrixXd& columns) const;

 private:
  struct Reflections;
  std::unique_ptr<const Reflections> reflections_;
};

/// Computes the factor R of the Householder QR decomposition of a matrix with at least as many rows as columns. R has
/// the size columns × columns.
Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& matrix);

/// Computes A⁻¹ b for a positive definite A, by Cholesky factorisation.
Eigen::VectorXd solve_positive_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

struct RightSingular {
  Eigen::VectorXd values;   ///< the min(rows, columns) singular values in descending order
  Eigen::MatrixXd vectors;  ///< right singular vectors V; V has columns × columns entries
};
RightSingular right_singular(const Eigen::MatrixXd& matrix);

/// Computes the singular values in descending order; their number is min(rows, columns).
Eigen::VectorXd singular_values_of(const Eigen::MatrixXd& matrix);

}  // namespace isojam
