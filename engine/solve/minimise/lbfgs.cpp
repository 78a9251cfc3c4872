#include <array>
#include <deque>

#include "engine/arithmetic/lanes.hpp"
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

/// a·b in 16 partial sums: a single sum would wait for every addition to end before the next one.
double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  std::array<Lanes, 4> sums;
  sums.fill(Lanes::all(0));
  const Eigen::Index whole = a.size() / 16 * 16;
  for (Eigen::Index k = 0; k < whole; k += 16) {
    for (int j = 0; j < 4; ++j) {
      const Eigen::Index at = k + 4 * j;
      sums[j] = sums[j] + Lanes::load(a.data() + at) * Lanes::load(b.data() + at);
    }
  }
  double rest = 0;
  for (Eigen::Index k = whole; k < a.size(); ++k) rest += a[k] * b[k];
  return sum((sums[0] + sums[1]) + (sums[2] + sums[3])).first() + rest;
}

/// y += factor · x
void add(double factor, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
  const Eigen::Index whole = y.size() / 4 * 4;
  for (Eigen::Index k = 0; k < whole; k += 4)
    (Lanes::load(y.data() + k) + Lanes::all(factor) * Lanes::load(x.data() + k)).store(y.data() + k);
  for (Eigen::Index k = whole; k < y.size(); ++k) y[k] += factor * x[k];
}

/// Computes −H g by the two-loop recursion, where H is the limited-memory inverse Hessian and g is the gradient.
Eigen::VectorXd descent_direction(const std::deque<Correction>& memory, const Eigen::VectorXd& gradient) {
  Eigen::VectorXd q = -gradient;
  std::vector<double> alpha(memory.size());
  for (std::size_t k = memory.size(); k-- > 0;) {
    alpha[k] = memory[k].inverse_product * dot(memory[k].step, q);
    add(-alpha[k], memory[k].change, q);
  }
  const Correction& last = memory.back();
  q *= 1 / (last.inverse_product * dot(last.change, last.change));
  for (std::size_t k = 0; k < memory.size(); ++k) {
    const double beta = memory[k].inverse_product * dot(memory[k].change, q);
    add(alpha[k] - beta, memory[k].step, q);
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
    const double product = dot(correction.step, correction.change);
    // a step that satisfies the strong Wolfe conditions has a positive product, but a truncated step may not
    if (!(product > 0)) continue;
    correction.inverse_product = 1 / product;
    memory.push_back(std::move(correction));
    if (memory.size() > stored_corrections) memory.pop_front();
  }
}

}  // namespace isojam
