#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/minimise/descent.hpp"

// Near jamming the stiffnesses of a packing span ten orders of magnitude, which first-order methods feel as the
// condition number and Newton's method does not. What limits Newton's is what the Hessian does not know: pairs that
// close along the step, and flat contacts whose tilt costs nothing until their section line cuts the face. The shift μ
// shortens every step (Levenberg, Marquardt); the tilt term, which rises with it, turns steps away from tilting flat
// contacts long before μ has to shorten them.

namespace isojam {

namespace {

/// The tilt term is complete, as it stands in SecondOrder, once μ reaches this fraction of the stiffest diagonal
/// entry. Measured over 1e-5 … 1e-7: evaluations change little, and multiply without the term.
constexpr double complete_at = 1e-6;

double largest_diagonal(const BlockMatrix& matrix) {
  double largest = 0;
  for (const Matrix6d& block : matrix.diagonal) largest = std::max(largest, block.diagonal().maxCoeff());
  return largest;
}

/// The shift μ, adapted to how well the quadratic model predicted the last step.
class Shift {
 public:
  void set_scale(double stiffness) {
    scale_ = stiffness;
    least_ = 16 * std::numeric_limits<double>::epsilon() * stiffness;
    // Beyond it a step is gradient descent by next to nothing, even where faces that close are about to become
    // as stiff as contacts can be (of order 1) while nothing in the Hessian says so.
    most_ = 1e6 * std::max(stiffness, 1.0);
    if (value_ == 0) value_ = 1e-4 * stiffness;
    value_ = std::max(value_, least_);
  }
  double value() const { return value_; }
  double tilt_factor() const { return std::min(1.0, value_ / (complete_at * scale_)); }
  bool exhausted() const { return value_ > most_; }
  /// After a step that failed: faster and faster.
  void raise() {
    value_ *= growth_;
    growth_ *= 2;
  }
  /// After a step that was accepted, by the ratio of its actual to its predicted decrease (Nielsen's rule).
  void adapt(double ratio) {
    value_ = std::max(value_ * std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3)), least_);
    growth_ = 2;
  }

 private:
  double value_ = 0, scale_ = 0, growth_ = 2, least_ = 0, most_ = 0;
};

/// Tries one step with the current shift. True if it was accepted.
bool try_step(Descent& descent, const SecondOrder& model, BlockCholesky& factor, Shift& shift) {
  while (!factor.factorise(stiffened(model.hessian, model.tilts, shift.tilt_factor()), shift.value())) {
    shift.raise();
    if (shift.exhausted()) return false;
  }
  const Evaluation& here = descent.here();
  Eigen::VectorXd step = -factor.solve(here.gradient);
  step *= std::min(1.0, descent.longest_displacement() / largest_displacement(step));
  const double predicted = -here.gradient.dot(step) - step.dot(model.hessian * step) / 2;
  Packing there = descent.packing();
  Evaluation value = descent.probe(step, there);
  const double actual = here.energy - value.energy;
  // Where energies no longer resolve the step, the forces decide.
  const bool resolved = predicted > here.energy_noise;
  const bool accepted = resolved ? actual > 1e-4 * predicted
                                 : actual > -here.energy_noise && value.gradient.norm() < here.gradient.norm();
  if (!accepted) {
    shift.raise();
    return false;
  }
  shift.adapt(resolved ? actual / predicted : 1);
  descent.accept(std::move(there), std::move(value));
  return true;
}

}  // namespace

MinimiseSummary minimise_newton(Descent& descent) {
  BlockCholesky factor;
  Shift shift;
  while (true) {
    if (const auto reason = descent.verdict()) return descent.finish(*reason);
    const SecondOrder model = descent.second_order();
    shift.set_scale(largest_diagonal(model.hessian));
    while (!try_step(descent, model, factor, shift)) {
      if (shift.exhausted()) return descent.finish(StopReason::line_search_failed);
      if (const auto reason = descent.verdict()) return descent.finish(*reason);
    }
  }
}

}  // namespace isojam
