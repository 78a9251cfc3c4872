#pragma once

#include <Eigen/Core>
#include <functional>

#include "engine/packing/packing.hpp"

namespace isojam {

/// Energy and gradient (6N, as Evaluation::gradient) of a packing.
struct EnergyAndGradient {
  double energy = 0;
  Eigen::VectorXd gradient;
};
using EnergyFunction = std::function<EnergyAndGradient(const Packing&)>;

struct GradientCheck {
  /// Largest distance between g·d and the central difference along d, in units of what the mean value theorem and
  /// rounding allow. At most 1 if the gradient is right.
  double worst = 0;
  Eigen::Index entry = -1;  ///< coordinate of the worst; −1 for a random direction
  double allowed = 0;       ///< the tolerance of the worst, relative to the largest entry of the gradient

  bool passes() const { return worst <= 1; }
};

/// Compares the gradient of `function` with central differences of its energy over ±step (a length), along every
/// coordinate and along as many random directions, up to the first that gives it the lie. The mean value theorem says
/// that the difference quotient is the slope somewhere in between, so it may differ from the slope in the middle by no
/// more than slopes vary there.
GradientCheck check_gradient(const EnergyFunction& function, const Packing& packing, double step, RandomStream& random);

}  // namespace isojam
