#pragma once

#include <Eigen/Core>
#include <functional>

#include "engine/packing/packing.hpp"

namespace isojam {

/// Energy and gradient (6N entries, as Evaluation::gradient) of a packing.
struct EnergyAndGradient {
  double energy = 0;
  Eigen::VectorXd gradient;
};
using EnergyFunction = std::function<EnergyAndGradient(const Packing&)>;

struct GradientCheck {
  /// Largest distance between g·d and the central difference along d, divided by the tolerance from the mean value
  /// theorem and rounding. At most 1 if the gradient is correct.
  double worst = 0;
  Eigen::Index entry = -1;  ///< coordinate of the largest; −1 for a random direction
  double allowed = 0;       ///< its tolerance, relative to the largest entry of the gradient

  bool passes() const { return worst <= 1; }
};

/// Compares the gradient of `function` with central differences of its energy over ±step (a length), along every
/// coordinate and along as many random directions, up to the first contradiction. By the mean value theorem the
/// difference quotient is the slope somewhere in between. It may therefore differ from the slope in the middle by at
/// most the variation of slopes there.
GradientCheck check_gradient(const EnergyFunction& function, const Packing& packing, double step, RandomStream& random);

}  // namespace isojam
