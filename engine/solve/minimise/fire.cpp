#include <algorithm>
#include <cmath>

#include "engine/solve/minimise/descent.hpp"

// FIRE: damped dynamics. It sets the velocity to zero when the motion is uphill (Bitzek, Koskinen, Gähler, Moseler &
// Gumbsch 2006). All masses in the coordinates (x, R·θ) are 1, and the constants are those of that paper.

namespace isojam {

namespace {

constexpr double grow = 1.1, shrink = 0.5, first_mixing = 0.1, mixing_decay = 0.99;
constexpr int downhill_before_growth = 5;

/// Time steps in units of 1/√λ, where λ is the largest diagonal entry of the Hessian.
constexpr double first_time = 0.1, longest_time = 100;

struct Motion {
  Eigen::VectorXd velocity;
  double time = 0, mixing = first_mixing;
  int downhill = 0;
};

/// Rotates the velocity towards the force. If the velocity points uphill, sets it to zero instead.
void steer(const Eigen::VectorXd& force, double longest, Motion& motion) {
  if (force.dot(motion.velocity) > 0) {
    motion.velocity =
        (1 - motion.mixing) * motion.velocity + motion.mixing * motion.velocity.norm() / force.norm() * force;
    if (++motion.downhill > downhill_before_growth) {
      motion.time = std::min(grow * motion.time, longest);
      motion.mixing *= mixing_decay;
    }
  } else {
    motion.velocity.setZero();
    motion.time *= shrink;
    motion.mixing = first_mixing;
    motion.downhill = 0;
  }
}

}  // namespace

MinimiseSummary minimise_fire(Descent& descent) {
  if (const auto reason = descent.verdict()) return descent.finish(*reason);
  Packing current = descent.packing();
  Evaluation value = descent.here();
  double stiffest = 0;
  for (const Matrix6d& block : descent.second_order(current, 0).hessian.diagonal)
    stiffest = std::max(stiffest, block.diagonal().maxCoeff());
  const double period = 1 / std::sqrt(stiffest);
  Motion motion{Eigen::VectorXd::Zero(value.gradient.size()), first_time * period};
  while (true) {
    if (const auto reason = descent.verdict()) return descent.finish(*reason);
    if (!std::isfinite(value.energy)) return descent.finish(StopReason::not_finite);
    const Eigen::VectorXd force = -value.gradient;
    steer(force, longest_time * period, motion);
    motion.velocity += motion.time * force;
    Eigen::VectorXd step = motion.time * motion.velocity;
    step *= std::min(1.0, descent.longest_displacement() / largest_displacement(step));
    Packing next = current;
    value = descent.probe(current, step, next);
    current = std::move(next);
    // The dynamics may move uphill for a while. Only a better state is kept.
    if (value.energy < descent.here().energy || value.residual <= descent.options().residual)
      descent.accept(current, value);
  }
}

}  // namespace isojam
