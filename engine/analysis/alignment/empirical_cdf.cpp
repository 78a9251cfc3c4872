#include "engine/analysis/alignment/empirical_cdf.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isojam {

double EmpiricalCdf::operator()(double x) const {
  const auto above = std::upper_bound(values.begin(), values.end(), x);
  return above == values.begin() ? 0 : heights[above - values.begin() - 1];
}

EmpiricalCdf empirical_cdf(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  if (std::any_of(sorted.begin(), sorted.end(), [](double value) { return std::isnan(value); }))
    throw std::invalid_argument("an empirical CDF needs numbers");
  std::sort(sorted.begin(), sorted.end());
  EmpiricalCdf cdf;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (k + 1 < sorted.size() && sorted[k + 1] == sorted[k]) continue;
    cdf.values.push_back(sorted[k]);
    cdf.heights.push_back(static_cast<double>(k + 1) / static_cast<double>(sorted.size()));
  }
  return cdf;
}

double kolmogorov_distance(const EmpiricalCdf& empirical, const std::function<double(double)>& distribution) {
  double distance = 0, before = 0;
  for (std::size_t k = 0; k < empirical.values.size(); ++k) {
    const double expected = distribution(empirical.values[k]);
    distance = std::max({distance, std::abs(empirical.heights[k] - expected), std::abs(before - expected)});
    before = empirical.heights[k];
  }
  return distance;
}

double kolmogorov_probability(double distance, long n) {
  const double root = std::sqrt(static_cast<double>(n));
  const double lambda = (root + 0.12 + 0.11 / root) * distance;
  if (!(lambda > 0.2)) return 1;  // accurate to 1e-12; the series converges slowly there
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2 : -2) * nearest::exp(-2 * k * k * lambda * lambda);
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace isojam
