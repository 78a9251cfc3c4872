#pragma once

#include <optional>
#include <span>

namespace isojam {

/// Power law y = prefactor · x^exponent, by least squares in logarithms.
struct PowerLaw {
  double exponent = 0, prefactor = 0;  ///< as above
  double standard_error = 0;           ///< of the exponent; 0 with two points
  double ci95_half_width = 0;          ///< of the exponent, Student t on n − 2 degrees of freedom; 0 with two points
  int points = 0;                      ///< that were fitted
};

/// Fits the points with x > 0 and y > 0. nullopt if fewer than two x among them differ: with an interval, three are
/// needed. Throws std::invalid_argument if there are not as many y as x.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

}  // namespace isojam
