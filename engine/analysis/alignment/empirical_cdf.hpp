#pragma once

#include <span>
#include <vector>

namespace isojam {

/// Empirical cumulative distribution function c of n numbers. c is 0 below values[0]. It is heights[k] from values[k]
/// to values[k + 1], and the last height is 1. Equal numbers form one step.
struct EmpiricalCdf {
  std::vector<double> values;   ///< the different numbers in ascending order
  std::vector<double> heights;  ///< value of c at each element of `values`

  /// The fraction of numbers that are at most x; 0 if there are no numbers.
  double operator()(double x) const;
};

/// Makes the distribution function of numbers in any order. Throws std::invalid_argument if a number is NaN.
EmpiricalCdf empirical_cdf(std::span<const double> values);

}  // namespace isojam
