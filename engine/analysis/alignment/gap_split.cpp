#include "engine/analysis/alignment/gap_split.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

constexpr std::size_t least_angles = 10;  // fewer angles may be separated by chance

/// log θ of the angles below `upper`, ascending.
std::vector<double> logarithms(std::span<const double> angles, double upper, double resolution) {
  std::vector<double> result;
  for (const double angle : angles) {
    if (!(angle >= 0) || !std::isfinite(angle)) throw std::invalid_argument("angles to split must be 0 or more");
    if (angle < upper) result.push_back(nearest::log(std::max(angle, resolution)));
  }
  std::sort(result.begin(), result.end());
  return result;
}

struct Split {
  std::size_t below = 0;
  double separation = 0;
};

/// The division with the largest η. It never separates equal values; η is 0 if all values are equal.
Split best_split(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
  double variance = 0;
  for (const double value : x) variance += (value - mean) * (value - mean) / n;
  Split best;
  double sum = 0;  // sum of deviations from the mean below the split
  for (std::size_t k = 1; k < x.size(); ++k) {
    sum += x[k - 1] - mean;
    if (x[k] == x[k - 1]) continue;
    // w_0 w_1 (μ_1 − μ_0)², with both means relative to the mean of all values
    const auto below = static_cast<double>(k);
    const double separation = sum * sum / (below * (n - below) * variance);
    if (separation > best.separation) best = {k, separation};
  }
  return best;
}

}  // namespace

GapSplit split_at_gap(std::span<const double> angles, double upper, const GapOptions& options) {
  if (!(options.resolution > 0) || !(upper > options.resolution) || !std::isfinite(upper))
    throw std::invalid_argument("a gap needs a window wider than the resolution of the angles");
  const std::vector<double> x = logarithms(angles, upper, options.resolution);
  GapSplit result;
  if (x.size() < least_angles) {
    result.verdict = GapVerdict::too_few;
    return result;
  }
  const auto cut_between = [&](double from, double to, std::size_t below) {
    result.cutoff = nearest::exp((from + to) / 2);
    result.below = static_cast<int>(below);
  };
  const Split split = best_split(x);
  result.separation = split.separation;
  result.critical = 0.75 + options.quantile * std::sqrt(0.075 / static_cast<double>(x.size()));
  if (x.back() - x.front() < nearest::log(upper) - x.back()) {
    result.verdict = GapVerdict::all_alike;
    cut_between(x.back(), nearest::log(upper), x.size());
  } else if (split.separation > result.critical) {
    result.verdict = GapVerdict::separated;
    cut_between(x[split.below - 1], x[split.below], split.below);
  } else {
    result.verdict = GapVerdict::no_gap;
  }
  return result;
}

}  // namespace isojam
