#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace isojam {

/// A symmetric operator as Spectra takes it, whatever stands behind it. One type for all, so that its solvers are
/// compiled once.
class LanczosOperation {
 public:
  using Scalar = double;

  /// `operation` has rows(), perform_op(x, y) and set_shift(σ), and must outlive this.
  template <class Operation>
  explicit LanczosOperation(Operation& operation)
      : rows_(operation.rows()),
        perform_([&operation](const double* x, double* y) { operation.perform_op(x, y); }),
        shift_([&operation](double sigma) { operation.set_shift(sigma); }) {}

  Eigen::Index rows() const { return rows_; }
  Eigen::Index cols() const { return rows_; }
  void perform_op(const double* x, double* y) const { perform_(x, y); }
  void set_shift(double sigma) { shift_(sigma); }

 private:
  Eigen::Index rows_;
  std::function<void(const double*, double*)> perform_;
  std::function<void(double)> shift_;
};

enum class LanczosWanted { least, greatest };

struct LanczosRequest {
  LanczosWanted wanted = LanczosWanted::greatest;  ///< end of the spectrum; of no meaning with a shift
  Eigen::Index modes = 1, subspace = 20;           ///< eigenpairs, and dimension of the Krylov space that is kept
  /// With a shift the operation is (A − σ)⁻¹, and the eigenvalues nearest σ are wanted.
  std::optional<double> shift = std::nullopt;
  double tolerance = 1e-10;  ///< relative accuracy of an eigenvalue (of 1/(λ − σ))
  int restarts = 300;
  Eigen::VectorXd start{};  ///< of rows() entries; empty: Spectra's own random one
};

enum class LanczosEnd {
  converged,
  restarts_spent,
  small_problem_failed  ///< the dense eigenproblem in the Krylov space did not converge
};

struct LanczosModes {
  LanczosEnd ended = LanczosEnd::restarts_spent;
  Eigen::VectorXd eigenvalues;  ///< of A, in Spectra's order; empty unless converged
  Eigen::MatrixXd vectors;      ///< columns in the same order
  long products = 0;            ///< operations performed
};

/// Implicitly restarted Lanczos (Spectra). What the operation throws, such as at a shift that is an eigenvalue, goes
/// through.
LanczosModes lanczos(LanczosOperation operation, const LanczosRequest& request);

}  // namespace isojam
