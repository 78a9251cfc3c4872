#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace isojam {

struct Interval {
  double low = 0, high = 0;
};

/// Mean over replicates with its uncertainty. Confidence intervals need at least two values.
struct Estimate {
  int n = 0;
  std::optional<double> mean;           ///< nullopt if n = 0
  std::optional<double> sd;             ///< standard deviation of the sample, n − 1 degrees of freedom
  std::optional<double> half_width;     ///< t_{0.975, n−1} · sd / √n
  std::optional<Interval> ci95;         ///< mean ± half_width
  std::optional<Interval> bootstrap95;  ///< 95 % bootstrap interval: percentiles of the means of bootstrap samples
};

inline constexpr int bootstrap_resamples = 2000;
/// Largest number of values for which a bootstrap interval is computed. With more values the bootstrap takes minutes,
/// and its interval agrees with Student's interval.
inline constexpr int most_bootstrapped = 1000;

/// Estimates a mean. The result has the same bits for any order of `values`. The random stream of the bootstrap depends
/// only on `key` and n.
Estimate estimate(std::vector<double> values, std::uint64_t key);

/// Half width t_{0.975, n−1} · sd / √n of the 95 % confidence interval; nullopt for fewer than two values. The result
/// has the same bits for any order of `values`.
std::optional<double> student_half_width(std::vector<double> values);

}  // namespace isojam
