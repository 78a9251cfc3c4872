#pragma once

#include <optional>
#include <span>

namespace isojam {

/// Power law y = prefactor · x^exponent, fitted by least squares of the logarithms.
struct PowerLaw {
  double exponent = 0, prefactor = 0;  ///< parameters of the law
  double standard_error = 0;           ///< standard error of the exponent; 0 if only two points are fitted
  /// half width of the 95 % confidence interval of the exponent (Student t with n − 2 degrees of freedom); 0 if only
  /// two points are fitted
  double ci95_half_width = 0;
  int points = 0;  ///< number of points in the fit
};

/// Fits the points with x > 0 and y > 0. Returns nullopt unless these points have at least two different x. Throws
/// std::invalid_argument if x and y have different sizes.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

}  // namespace isojam
