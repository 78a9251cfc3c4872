#include <algorithm>

#include "engine/solve/minimise/descent.hpp"

namespace isojam {

namespace {

/// The method needs a nearly exact line search; otherwise its directions are no longer conjugate.
constexpr double curvature = 0.1;

/// Largest displacement of a particle in the first trial step. Any small length works, because later steps adapt.
constexpr double first_displacement = 1e-3;

}  // namespace

/// Nonlinear conjugate gradients with β = max(0, g·(g − g_old)/g_old·g_old) (Polak, Ribière). They restart when β is
/// negative.
MinimiseSummary minimise_conjugate_gradient(Descent& descent) {
  Eigen::VectorXd gradient, direction;
  double slope_before = 0;
  bool steepest = true;
  while (true) {
    if (const auto reason = descent.verdict()) return descent.finish(*reason);
    const Eigen::VectorXd& g = descent.here().gradient;
    if (!steepest) {
      const double beta = std::max(0.0, g.dot(g - gradient) / gradient.squaredNorm());
      direction = beta * direction - g;
      steepest = !(direction.dot(g) < 0);
    }
    if (steepest) direction = -g;
    gradient = g;
    const double slope = direction.dot(g);
    const double guess =
        slope_before < 0 ? descent.last_step() * slope_before / slope : first_displacement / largest_displacement(g);
    const bool was_steepest = steepest;
    steepest = false;
    slope_before = slope;
    if (descent.advance(direction, guess, curvature)) continue;
    if (was_steepest) return descent.finish(StopReason::line_search_failed);
    steepest = true;
    slope_before = 0;
  }
}

}  // namespace isojam
