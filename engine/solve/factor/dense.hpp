#pragma once

#include <Eigen/Core>
#include <memory>

namespace isojam {

// Eigen's dense decompositions, each compiled once: they are half a minute of templates wherever they are included.

/// Eigenvalues of a symmetric matrix, of which the lower half is read; ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending; empty if the iteration did not converge
  Eigen::MatrixXd vectors;  ///< columns, orthonormal
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// An orthonormal basis of the span of independent columns, by Householder reflections; as many columns.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// An orthogonal basis of all space, of which the first vectors span independent columns.
class CompletedBasis {
 public:
  explicit CompletedBasis(const Eigen::MatrixXd& columns);
  ~CompletedBasis();
  CompletedBasis(const CompletedBasis&) = delete;
  CompletedBasis& operator=(const CompletedBasis&) = delete;

  /// A becomes QᵀAQ: A in this basis.
  void enter(Eigen::MatrixXd& matrix) const;
  /// Columns in this basis become Q·columns.
  void leave(Eigen::MatrixXd& columns) const;

 private:
  struct Reflections;
  std::unique_ptr<const Reflections> reflections_;
};

/// R of the Householder QR of a matrix with no more columns than rows: columns × columns.
Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& matrix);

/// A⁻¹ b of a positive definite A, by Cholesky.
Eigen::VectorXd solve_positive_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

struct RightSingular {
  Eigen::VectorXd values;   ///< descending, min(rows, columns)
  Eigen::MatrixXd vectors;  ///< V, columns × columns
};
RightSingular right_singular(const Eigen::MatrixXd& matrix);

/// Descending, as many as the lesser of rows and columns.
Eigen::VectorXd singular_values_of(const Eigen::MatrixXd& matrix);

}  // namespace isojam
