#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "engine/solve/factor/block_cholesky.hpp"

namespace isojam {

/// The operator (H − σ·1)⁻¹ for any σ that is not an eigenvalue of H. It uses BlockCholesky if H − σ·1 is positive
/// definite, and SimplicialLDLT of Eigen otherwise. It has the interface that the shift-invert solvers of Spectra
/// require. H must outlive the operator.
///
///   ShiftInvert operation(hessian);
///   Spectra::SymEigsShiftSolver<ShiftInvert> solver(operation, 53, 120, -1e-9 * lambda_max);
class ShiftInvert {
 public:
  using Scalar = double;

  explicit ShiftInvert(const BlockMatrix& matrix) : matrix_(matrix) {}

  Eigen::Index rows() const { return matrix_.rows(); }
  Eigen::Index cols() const { return rows(); }
  /// Factorises H − σ·1. Throws std::domain_error if a pivot is zero or not finite. This happens if H contains NaN. It
  /// also happens if σ is, within rounding errors, an eigenvalue of H or of a leading submatrix of the reordered H.
  void set_shift(double sigma);
  /// Computes y = (H − σ·1)⁻¹ x. x and y have rows() entries.
  void perform_op(const double* x, double* y) const;

  bool positive_definite() const { return positive_definite_; }  ///< true if H − σ·1 is positive definite
  /// Number of eigenvalues of H below σ, from the number of negative pivots (Sylvester's law of inertia).
  int negative_pivots() const { return negative_pivots_; }

 private:
  const BlockMatrix& matrix_;
  BlockCholesky cholesky_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt_;
  bool positive_definite_ = false;
  int negative_pivots_ = 0;
};

/// The lower half of H + shift·1 as a sparse matrix.
Eigen::SparseMatrix<double> lower_half(const BlockMatrix& matrix, double shift);

}  // namespace isojam
