#include "tasks/tables/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "engine/random/stream.hpp"
#include "engine/solve/straight_line.hpp"

namespace isojam {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Percentile of sorted values, interpolated linearly between neighbouring values.
double percentile(std::span<const double> sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Interval bootstrap(std::span<const double> values, std::uint64_t key) {
  const auto n = values.size();
  RandomStream random{key, n, static_cast<std::uint64_t>(Purpose::bootstrap)};
  std::vector<double> resample(n), means(bootstrap_resamples);
  for (auto& mean : means) {
    for (auto& x : resample) x = values[static_cast<std::size_t>(random.uniform() * static_cast<double>(n))];
    mean = mean_of(resample);
  }
  std::sort(means.begin(), means.end());
  return {percentile(means, 0.025), percentile(means, 0.975)};
}

/// Standard deviation of a sample of at least two values.
double sd_of(std::span<const double> values, double mean) {
  double squares = 0;
  for (const double x : values) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// Half width of the 95 % confidence interval of a mean.
double half_width_at(double sd, std::size_t n) {
  const auto count = static_cast<double>(n);
  return student_95(count - 1) * sd / std::sqrt(count);
}

}  // namespace

std::optional<double> student_half_width(std::vector<double> values) {
  if (values.size() < 2) return std::nullopt;
  std::sort(values.begin(), values.end());
  return half_width_at(sd_of(values, mean_of(values)), values.size());
}

Estimate estimate(std::vector<double> values, std::uint64_t key) {
  Estimate result;
  result.n = static_cast<int>(values.size());
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  const double mean = mean_of(values);
  result.mean = mean;
  if (result.n == 1) return result;

  result.sd = sd_of(values, mean);
  const double half = half_width_at(*result.sd, values.size());
  result.half_width = half;
  result.ci95 = Interval{mean - half, mean + half};
  if (result.n <= most_bootstrapped) result.bootstrap95 = bootstrap(values, key);
  return result;
}

}  // namespace isojam
