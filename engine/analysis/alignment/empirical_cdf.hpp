#pragma once

#include <span>
#include <vector>

namespace isojam {

/// Empirical cumulative distribution function c of n values. c is 0 below values[0], and heights[k] from values[k] to
/// values[k + 1]; the last height is 1. Equal values form one step.
struct EmpiricalCdf {
  std::vector<double> values;   ///< different values in ascending order
  std::vector<double> heights;  ///< value of c from each element of `values` on

  /// The fraction of values that are at most x. 0 if there are no values.
  double operator()(double x) const;
};

/// Makes the distribution function of values, which may be in any order. Throws std::invalid_argument if a value is
/// NaN.
EmpiricalCdf empirical_cdf(std::span<const double> values);

}  // namespace isojam
