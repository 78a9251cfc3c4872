#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace isojam {

struct Interval {
  double low = 0, high = 0;
};

/// Mean over replicates, and its uncertainty. The last four members are nullopt for fewer than two values.
struct Estimate {
  int n = 0;
  std::optional<double> mean;        ///< nullopt if n = 0
  std::optional<double> sd;          ///< standard deviation of the sample, n − 1 degrees of freedom
  std::optional<double> half_width;  ///< t_{0.975, n−1} · sd / √n
  std::optional<Interval> ci95;      ///< mean ± half_width
  /// 95 % bootstrap interval: percentiles of the means of resamples; nullopt for too many values
  std::optional<Interval> bootstrap95;
};

/// Number of resamples of a bootstrap.
inline constexpr int bootstrap_resamples = 2000;
/// Largest number of values for which a bootstrap interval is computed. For more values, the bootstrap takes minutes
/// and its interval agrees with Student's.
inline constexpr int most_bootstrapped = 1000;

/// Estimates the mean of `values`. The result has the same bits for any order of `values`. The random numbers of the
/// bootstrap depend only on `key` and the number of values.
Estimate estimate(std::vector<double> values, std::uint64_t key);

/// half_width of estimate(). The result has the same bits for any order of `values`.
std::optional<double> student_half_width(std::vector<double> values);

}  // namespace isojam
