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
    throw std::invalid_argument("the values of an empirical CDF must be numbers");
  std::sort(sorted.begin(), sorted.end());
  EmpiricalCdf cdf;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (k + 1 < sorted.size() && sorted[k + 1] == sorted[k]) continue;
    cdf.values.push_back(sorted[k]);
    cdf.heights.push_back(static_cast<double>(k + 1) / static_cast<double>(sorted.size()));
  }
  return cdf;
}

}  // namespace isojam
