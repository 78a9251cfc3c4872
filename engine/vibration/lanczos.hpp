#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace isojam {

/// A symmetric operator with the interface that the library Spectra requires. All operators have this one type, so that
/// the solvers of Spectra are compiled only once.
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
  /// the end of the spectrum at which eigenvalues are computed; not used if there is a shift
  LanczosWanted wanted = LanczosWanted::greatest;
  Eigen::Index modes = 1, subspace = 20;  ///< number of eigenpairs, and dimension of the Krylov space
  /// If there is a shift σ, the operation is (A − σ)⁻¹, and the eigenvalues of A nearest to σ are computed. Otherwise
  /// the operation is A.
  std::optional<double> shift = std::nullopt;
  /// largest residual of an eigenpair of the operation, divided by |λ|, or by 1/|λ − σ| if there is a shift
  double tolerance = 1e-10;
  int restarts = 300;
  Eigen::VectorXd start{};  ///< start vector with rows() entries; if it is empty, Spectra makes a random vector
};

enum class LanczosEnd {
  converged,
  restarts_spent,
  small_problem_failed  ///< the dense eigenvalue problem in the Krylov space did not converge
};

struct LanczosModes {
  LanczosEnd ended = LanczosEnd::restarts_spent;
  /// eigenvalues of A in the order in which Spectra returns them; empty unless the method converged
  Eigen::VectorXd eigenvalues;
  Eigen::MatrixXd vectors;  ///< eigenvectors as columns, in the same order
  long products = 0;        ///< number of times that the operation was applied
};

/// Computes eigenpairs by the implicitly restarted Lanczos method (Spectra). If the shift is an eigenvalue and the
/// operation throws std::domain_error, the caller receives this exception.
LanczosModes lanczos(LanczosOperation operation, const LanczosRequest& request);

}  // namespace isojam
