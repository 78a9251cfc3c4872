#include <deque>

#include "engine/solve/minimise/descent.hpp"

namespace isojam {

namespace {

constexpr double curvature = 0.9;
constexpr double first_displacement = 1e-3;
constexpr std::size_t stored_corrections = 20;

/// A step and the change of the gradient in this step.
struct Correction {
  Eigen::VectorXd step, change;
  double inverse_product = 0;
};

/// Computes −H g by the two-loop recursion, where H is the limited-memory inverse Hessian and g is the gradient.
Eigen::VectorXd descent_direction(const std::deque<Correction>& memory, const Eigen::VectorXd& gradient) {
  Eigen::VectorXd q = -gradient;
  std::vector<double> alpha(memory.size());
  for (std::size_t k = memory.size(); k-- > 0;) {
    alpha[k] = memory[k].inverse_product * memory[k].step.dot(q);
    q -= alpha[k] * memory[k].change;
  }
  const Correction& last = memory.back();
  q *= 1 / (last.inverse_product * last.change.squaredNorm());
  for (std::size_t k = 0; k < memory.size(); ++k) {
    const double beta = memory[k].inverse_product * memory[k].change.dot(q);
    q += (alpha[k] - beta) * memory[k].step;
  }
  return q;
}

}  // namespace

/// Limited-memory BFGS. The coordinates R·dθ of a step are relative to the orientations at its start.
MinimiseSummary minimise_lbfgs(Descent& descent) {
  std::deque<Correction> memory;
  while (true) {
    if (const auto reason = descent.verdict()) return descent.finish(*reason);
    const Eigen::VectorXd gradient = descent.here().gradient;
    const Eigen::VectorXd direction = memory.empty() ? Eigen::VectorXd(-gradient) : descent_direction(memory, gradient);
    const double first_step = memory.empty() ? first_displacement / largest_displacement(gradient) : 1;
    if (!descent.advance(direction, first_step, curvature)) {
      if (memory.empty()) return descent.finish(StopReason::line_search_failed);
      memory.clear();
      continue;
    }
    Correction correction{descent.last_step() * direction, descent.here().gradient - gradient, 0};
    const double product = correction.step.dot(correction.change);
    // a step that satisfies the strong Wolfe conditions has a positive product, but a truncated step may not
    if (!(product > 0)) continue;
    correction.inverse_product = 1 / product;
    memory.push_back(std::move(correction));
    if (memory.size() > stored_corrections) memory.pop_front();
  }
}

}  // namespace isojam
