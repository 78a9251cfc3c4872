#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/packing/block_matrix.hpp"
#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/factor/incomplete_cholesky.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// Solves (H + shift·1) x = b for a positive definite matrix. The cost of a complete factorisation grows faster than
/// the square of the number of particles. For large systems, solve() therefore first uses conjugate gradients with an
/// incomplete factorisation as the preconditioner. If this method does not converge soon, solve() uses the
/// complete factorisation.
class DefiniteSolver {
 public:
  /// `complete` is the memory for complete factorisations, the largest object of a large system. Several solvers can
  /// use the same one in turn.
  explicit DefiniteSolver(BlockCholesky& complete) : complete_(complete) {}

  /// Returns nullopt if the matrix is found to be not positive definite. Conjugate gradients can overlook this. They
  /// end when √(r·P⁻¹r) is at most `tolerance` times its initial value, where r is the residual vector and P the
  /// preconditioner. The numbers of operations are added to `work`.
  std::optional<Eigen::VectorXd> solve(const BlockMatrix& matrix, double shift, const Eigen::VectorXd& b,
                                       double tolerance, MinimiseWork& work);

 private:
  BlockCholesky& complete_;
  IncompleteCholesky incomplete_;
};

/// Outcome of conjugate gradients.
struct IterativeSolution {
  enum class End { converged, negative_curvature, not_converged } end = End::not_converged;
  Eigen::VectorXd x;
  int iterations = 0;
};

/// Conjugate gradients for (H + shift·1) x = b with the preconditioner P, an incomplete factorisation.
IterativeSolution conjugate_gradients(const BlockMatrix& matrix, double shift, const IncompleteCholesky& preconditioner,
                                      const Eigen::VectorXd& b, double tolerance, int most_iterations);

}  // namespace isojam
