#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/analysis/alignment/empirical_cdf.hpp"

namespace isojam::oracle {

/// Kolmogorov distance sup |c − F| between an empirical distribution c and a continuous distribution function F. It is
/// 0 if there are no values.
inline double kolmogorov_distance(const EmpiricalCdf& empirical, const std::function<double(double)>& distribution) {
  double distance = 0, before = 0;
  for (std::size_t k = 0; k < empirical.values.size(); ++k) {
    const double expected = distribution(empirical.values[k]);
    distance = std::max({distance, std::abs(empirical.heights[k] - expected), std::abs(before - expected)});
    before = empirical.heights[k];
  }
  return distance;
}

/// Probability that sup |c − F| exceeds `distance` for n independent values with the distribution F. It is 2 Σ_k
/// (−1)^(k−1) exp(−2k²λ²) after Kolmogorov, with λ = (√n + 0.12 + 0.11/√n)·distance after Stephens. It is accurate to
/// about 1e-3 for n ≥ 8.
inline double kolmogorov_probability(double distance, long n) {
  const double root = std::sqrt(static_cast<double>(n));
  const double lambda = (root + 0.12 + 0.11 / root) * distance;
  if (!(lambda > 0.2)) return 1;  // the error is below 1e-12; the series would converge slowly
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2 * k * k * lambda * lambda);
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace isojam::oracle
