#pragma once

#include <span>
#include <vector>

namespace isojam {

/// Empirical distribution function c of n values: 0 below values[0], heights[k] from values[k] on, finally 1. Equal
/// values form one step.
struct EmpiricalCdf {
  std::vector<double> values;   ///< ascending, distinct
  std::vector<double> heights;  ///< same size as values

  /// Fraction of the values ≤ x; 0 if there are none.
  double operator()(double x) const;
};

/// Distribution function of values in any order. Throws std::invalid_argument if one is NaN.
EmpiricalCdf empirical_cdf(std::span<const double> values);

}  // namespace isojam
