#include "tasks/tables/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "engine/arithmetic/distributions.hpp"
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

/// Standard deviation of a sample of at least two values.
double sd_of(std::span<const double> values, double mean) {
  double squares = 0;
  for (const double x : values) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// student_95() of a number of values. It takes a second for a hundred thousand values, and all quantities of a row
/// usually have the same number.
double student_of(std::size_t values) {
  thread_local std::map<std::size_t, double> known;
  const auto [place, is_new] = known.try_emplace(values);
  if (is_new) place->second = student_95(static_cast<double>(values - 1));
  return place->second;
}

/// Bootstrap-t interval. Its percentiles are those of (mean of a resample − mean) / (standard deviation of the
/// resample), instead of Student's.
std::optional<Interval> bootstrap(std::span<const double> values, double mean, double sd, std::uint64_t key) {
  const auto n = values.size();
  RandomStream random{key, n, static_cast<std::uint64_t>(Purpose::bootstrap)};
  std::vector<double> resample(n), ratios(bootstrap_resamples);
  for (auto& ratio : ratios) {
    for (auto& x : resample) x = values[static_cast<std::size_t>(random.uniform() * static_cast<double>(n))];
    const double of_resample = mean_of(resample), distance = of_resample - mean;
    // Infinite if all values of the resample are equal.
    ratio = distance == 0 ? 0 : distance / sd_of(resample, of_resample);
  }
  std::sort(ratios.begin(), ratios.end());
  const Interval interval{mean - percentile(ratios, 0.975) * sd, mean - percentile(ratios, 0.025) * sd};
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return std::nullopt;
  return interval;
}

/// Number, mean and standard deviation of the values, which are sorted first.
Estimate without_interval(std::vector<double>& values) {
  Estimate result;
  result.n = static_cast<int>(values.size());
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  result.mean = mean_of(values);
  if (result.n > 1) result.sd = sd_of(values, *result.mean);
  return result;
}

void use_half_width(Estimate& estimate, std::optional<double> half) {
  estimate.half_width = half;
  if (half) estimate.ci95 = Interval{*estimate.mean - *half, *estimate.mean + *half};
}

}  // namespace

std::optional<double> student_half_width(std::vector<double> values) {
  const auto n = values.size();
  return stein_half_width(std::move(values), n);
}

std::optional<double> stein_scale(std::vector<double> first) {
  if (first.size() < 2) return std::nullopt;
  std::sort(first.begin(), first.end());
  return student_of(first.size()) * sd_of(first, mean_of(first));
}

std::optional<double> stein_half_width(std::vector<double> first, std::size_t n) {
  const auto scale = stein_scale(std::move(first));
  return scale ? std::optional(*scale / std::sqrt(static_cast<double>(n))) : std::nullopt;
}

Interval wilson(double share, std::size_t n) {
  static const double z = normal_quantile(0.975);
  const auto count = static_cast<double>(n);
  const double middle = share + z * z / (2 * count), scale = 1 + z * z / count;
  const double half = z * std::sqrt(share * (1 - share) / count + z * z / (4 * count * count));
  return {std::max(0.0, (middle - half) / scale), std::min(1.0, (middle + half) / scale)};
}

Estimate estimate(std::vector<double> values, std::uint64_t key) {
  auto result = without_interval(values);
  if (result.n < 2) return result;
  use_half_width(result, student_half_width(values));
  if (result.n >= least_bootstrapped && result.n <= most_bootstrapped && *result.sd > 0)
    result.bootstrap95 = bootstrap(values, *result.mean, *result.sd, key);
  return result;
}

Estimate estimate_of_groups(const std::vector<double>& means, const std::vector<int>& sizes) {
  Estimate result;
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < means.size(); ++k) {
    result.n += sizes[k];
    sum += sizes[k] * means[k];
  }
  result.mean = sum / result.n;
  if (means.size() < 2) return result;
  for (std::size_t k = 0; k < means.size(); ++k)
    squares += sizes[k] * (means[k] - *result.mean) * (means[k] - *result.mean);
  result.sd = std::sqrt(squares / static_cast<double>(means.size() - 1));
  use_half_width(result, student_of(means.size()) * *result.sd / std::sqrt(result.n));
  return result;
}

Estimate proportion_estimate(std::vector<double> values) {
  auto result = without_interval(values);
  result.method = IntervalMethod::wilson;
  if (result.n < 2) return result;
  result.ci95 = wilson(*result.mean, values.size());
  result.half_width = (result.ci95->high - result.ci95->low) / 2;
  return result;
}

void use_stein(Estimate& estimate, const std::vector<double>& first) {
  if (estimate.n < 2) return;
  use_half_width(estimate, stein_half_width(first, static_cast<std::size_t>(estimate.n)));
  estimate.method = IntervalMethod::stein;
}

}  // namespace isojam
