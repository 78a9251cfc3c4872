#pragma once

#include <functional>

namespace isojam {

/// A point on a line through the space of coordinates: step t, energy f(t) and slope f'(t).
struct LinePoint {
  double step = 0, value = 0, slope = 0;
};

struct LineSearchOptions {
  double decrease = 1e-4;   ///< condition of sufficient decrease: f(t) ≤ f(0) + decrease·t·f'(0)
  double curvature = 0.1;   ///< condition of a small slope: |f'(t)| ≤ curvature·|f'(0)|
  double longest_step = 1;  ///< upper limit of the step t
  double noise = 0;         ///< rounding error of f; smaller differences of f are not significant
  int max_evaluations = 20;
};

struct LineSearchResult {
  /// true if a step with sufficient decrease was found; otherwise `point` is the start
  bool found = false;
  LinePoint point;
  int evaluations = 0;
};

/// Finds a step that satisfies the two conditions of LineSearchOptions (strong Wolfe conditions), by bracketing and
/// cubic interpolation. If no such step is found, the result is the best step with sufficient decrease. If energies
/// differ only by rounding errors, slopes are compared instead (approximate Wolfe conditions of Hager and Zhang).
/// Requires start.slope < 0 and first_step > 0.
LineSearchResult line_search(const std::function<LinePoint(double)>& at, const LinePoint& start, double first_step,
                             const LineSearchOptions& options);

}  // namespace isojam
