#pragma once

#include <span>
#include <vector>

namespace isojam {

/// Empirical distribution function c of n values: 0 below values[0], heights[k] from values[k] on, and at last 1. Equal
/// values make one step.
struct EmpiricalCdf {
  std::vector<double> values;   ///< ascending, distinct
  std::vector<double> heights;  ///< of the same size

  /// Fraction of the values ≤ x; 0 of none.
  double operator()(double x) const;
};

/// Distribution function of values in any order. Throws std::invalid_argument if one is not a number.
EmpiricalCdf empirical_cdf(std::span<const double> values);

}  // namespace isojam
