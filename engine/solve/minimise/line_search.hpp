#pragma once

#include <functional>

namespace isojam {

/// A point of the energy along a line: step t, energy f(t), slope f'(t).
struct LinePoint {
  double step = 0, value = 0, slope = 0;
};

struct LineSearchOptions {
  double decrease = 1e-4;   ///< sufficient decrease: f(t) ≤ f(0) + decrease·t·f'(0)
  double curvature = 0.1;   ///< |f'(t)| ≤ curvature·|f'(0)|
  double longest_step = 1;  ///< upper limit of steps
  double noise = 0;         ///< smaller differences of f are not significant
  int max_evaluations = 20;
};

struct LineSearchResult {
  bool found = false;  ///< if false, `point` is the lowest point found, possibly the start
  LinePoint point;
  int evaluations = 0;
};

/// Finds a step that satisfies the strong Wolfe conditions, by bracketing and cubic interpolation. If energies differ
/// only by rounding, slopes decide instead (approximate Wolfe conditions of Hager and Zhang). Requires start.slope < 0
/// and first_step > 0.
LineSearchResult line_search(const std::function<LinePoint(double)>& at, const LinePoint& start, double first_step,
                             const LineSearchOptions& options);

}  // namespace isojam
