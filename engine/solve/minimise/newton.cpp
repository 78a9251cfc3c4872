#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/minimise/descent.hpp"

// Near jamming the stiffnesses of a packing span ten orders of magnitude, which first-order methods feel as the
// condition number and Newton's method does not. What limits Newton's is that pairs which are not yet in contact are
// absent from the Hessian; the shift μ shortens steps that run into them (Levenberg, Marquardt).

namespace isojam {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double largest_diagonal(const BlockMatrix& matrix) {
  double largest = 0;
  for (const Matrix6d& block : matrix.diagonal) largest = std::max(largest, block.diagonal().maxCoeff());
  return largest;
}

/// The shift μ, adapted to how well the quadratic model predicted the last step.
class Shift {
 public:
  void set_scale(double stiffness) {
    least_ = 16 * epsilon * stiffness;
    most_ = 1e6 * stiffness;  // beyond it a step is gradient descent by next to nothing
    if (value_ == 0) value_ = 1e-4 * stiffness;
    value_ = std::max(value_, least_);
  }
  double value() const { return value_; }
  bool exhausted() const { return value_ > most_; }
  void raise(double factor) { value_ *= factor; }
  /// `ratio`: actual over predicted decrease of an accepted step.
  void adapt(double ratio) {
    if (ratio > 0.75) value_ = std::max(value_ / 8, least_);
    if (ratio < 0.25) value_ *= 2;
  }

 private:
  double value_ = 0, least_ = 0, most_ = 0;
};

/// Tries one step with the current shift. True if it was accepted.
bool try_step(Descent& descent, const BlockMatrix& hessian, BlockCholesky& factor, Shift& shift) {
  while (!factor.factorise(hessian, shift.value())) {
    shift.raise(4);
    if (shift.exhausted()) return false;
  }
  const Evaluation& here = descent.here();
  Eigen::VectorXd step = -factor.solve(here.gradient);
  const double longest = descent.longest_displacement();
  step *= std::min(1.0, longest / largest_displacement(step));
  const double predicted = -here.gradient.dot(step) - step.dot(hessian * step) / 2;
  Packing there = descent.packing();
  Evaluation value = descent.probe(step, there);
  const double actual = here.energy - value.energy;
  const double noise = 16 * epsilon * here.energy;
  // Where energies no longer resolve the step, the forces decide.
  const bool accepted = predicted > noise ? actual > 1e-4 * predicted
                                          : actual > -noise && value.gradient.norm() < here.gradient.norm();
  if (!accepted) {
    shift.raise(6);
    return false;
  }
  shift.adapt(predicted > noise ? actual / predicted : 1);
  descent.accept(std::move(there), std::move(value));
  return true;
}

}  // namespace

MinimiseSummary minimise_newton(Descent& descent) {
  if (const long warm_up = descent.options().warm_up; warm_up > 0) {
    const MinimiseSummary summary = minimise_lbfgs(descent, warm_up);
    if (summary.reason != StopReason::not_called && summary.reason != StopReason::line_search_failed) return summary;
  }
  BlockCholesky factor;
  Shift shift;
  while (true) {
    if (const auto reason = descent.verdict()) return descent.finish(*reason);
    const BlockMatrix hessian = descent.hessian();
    shift.set_scale(largest_diagonal(hessian));
    while (!try_step(descent, hessian, factor, shift)) {
      if (shift.exhausted()) return descent.finish(StopReason::line_search_failed);
      if (const auto reason = descent.verdict()) return descent.finish(*reason);
    }
  }
}

}  // namespace isojam
