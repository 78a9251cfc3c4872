#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace isojam {

/// A symmetric operator in the form that Spectra needs. The single type for all operators lets its solvers be compiled
/// once.
class LanczosOperation {
 public:
  using Scalar = double;

  /// `operation` must have rows(), perform_op(x, y) and set_shift(σ), and must outlive this object.
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
  LanczosWanted wanted = LanczosWanted::greatest;  ///< end of the spectrum; ignored with a shift
  Eigen::Index modes = 1, subspace = 20;           ///< number of eigenpairs, and dimension of the Krylov space
  /// If set, the operation is (A − σ)⁻¹, and the eigenvalues nearest to σ are computed.
  std::optional<double> shift = std::nullopt;
  double tolerance = 1e-10;  ///< relative accuracy of an eigenvalue (of 1/(λ − σ))
  int restarts = 300;
  Eigen::VectorXd start{};  ///< rows() entries; if empty, Spectra's own random vector
};

enum class LanczosEnd {
  converged,
  restarts_spent,
  small_problem_failed  ///< the dense eigenproblem in the Krylov space did not converge
};

struct LanczosModes {
  LanczosEnd ended = LanczosEnd::restarts_spent;
  Eigen::VectorXd eigenvalues;  ///< eigenvalues of A in Spectra's order; empty unless converged
  Eigen::MatrixXd vectors;      ///< columns in the same order
  long products = 0;            ///< operations performed
};

/// Implicitly restarted Lanczos method (Spectra). Exceptions of the operation, such as for a shift that is an
/// eigenvalue, are passed on.
LanczosModes lanczos(LanczosOperation operation, const LanczosRequest& request);

}  // namespace isojam
