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

/// Kolmogorov distance sup |c − F| over the real line; F is a continuous distribution function. 0 without values.
double kolmogorov_distance(const EmpiricalCdf& empirical, const std::function<double(double)>& distribution);

/// Probability P(sup |c − F| > distance) for n independent values drawn from F: Kolmogorov's 2 Σ_k (−1)^(k−1)
/// exp(−2k²λ²), with Stephens' λ = (√n + 0.12 + 0.11/√n)·distance; accurate to about 1e-3 for n ≥ 8.
double kolmogorov_probability(double distance, long n);

}  // namespace isojam
