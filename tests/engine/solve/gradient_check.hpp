#pragma once

#include <Eigen/Core>
#include <functional>

#include "engine/packing/packing.hpp"

namespace isojam {

/// Energy of a packing, and its gradient (6N entries, in the order of Evaluation::gradient).
struct EnergyAndGradient {
  double energy = 0;
  Eigen::VectorXd gradient;
};
using EnergyFunction = std::function<EnergyAndGradient(const Packing&)>;

struct GradientCheck {
  /// Largest difference between g·d and the central difference along d, divided by its tolerance. The tolerance follows
  /// from the mean value theorem and from rounding. If the gradient is correct, `worst` is at most 1.
  double worst = 0;
  Eigen::Index entry = -1;  ///< coordinate of this difference; −1 for a random direction
  double allowed = 0;       ///< tolerance of this difference, divided by the largest entry of the gradient

  bool passes() const { return worst <= 1; }
};

/// Compares the gradient of `function` with central differences of its energy, for displacements ±step (a length). It
/// tests the directions of all coordinates and as many random directions, and stops at the first error. By the mean
/// value theorem, a central difference equals the slope at some point between the two ends. It therefore differs from
/// the slope at the centre by at most the variation of the slope between the ends.
GradientCheck check_gradient(const EnergyFunction& function, const Packing& packing, double step, RandomStream& random);

}  // namespace isojam
