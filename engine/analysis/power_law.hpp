#pragma once

#include <optional>
#include <span>

namespace isojam {

/// Power law y = prefactor · x^exponent, by least squares in logarithms.
struct PowerLaw {
  double exponent = 0, prefactor = 0;  ///< parameters of the law
  double standard_error = 0;           ///< standard error of the exponent; 0 with two points
  double ci95_half_width = 0;  ///< of the exponent, from Student's t with n − 2 degrees of freedom; 0 with two points
  int points = 0;              ///< number of points in the fit
};

/// Fits the points with x > 0 and y > 0. nullopt if fewer than two of their x differ; a confidence interval needs three
/// points. Throws std::invalid_argument if the numbers of x and y differ.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

}  // namespace isojam
