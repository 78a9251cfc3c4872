#pragma once

#include <span>

namespace isojam {

/// Least-squares line y = intercept + slope·x.
struct Line {
  double intercept = 0, slope = 0;  ///< parameters of the line
  double squared_residual = 0;      ///< Σ (y − line)²
  /// squares of the standard errors of the parameters; 0 if there are only two points
  double intercept_variance = 0, slope_variance = 0;
};

/// Fits a line to at least two points. They must not all have the same x.
Line fit_line(std::span<const double> x, std::span<const double> y);

/// The quantile t with P(|T| < t) = 0.95, where T has Student's distribution. The number of degrees of freedom is
/// `degrees` ≥ 1, rounded to an integer.
double student_95(double degrees);

}  // namespace isojam
