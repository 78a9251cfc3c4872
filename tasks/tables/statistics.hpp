#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace isojam {

struct Interval {
  double low = 0, high = 0;
};

/// Mean over replicates with its uncertainty. Intervals need two or more values.
struct Estimate {
  int n = 0;
  std::optional<double> mean;           ///< nullopt if n = 0
  std::optional<double> sd;             ///< standard deviation of the sample, n − 1 degrees of freedom
  std::optional<double> half_width;     ///< t_{0.975, n−1} · sd / √n
  std::optional<Interval> ci95;         ///< mean ± half_width
  std::optional<Interval> bootstrap95;  ///< percentiles of the means of bootstrap samples
};

inline constexpr int bootstrap_resamples = 2000;
/// With more values the bootstrap takes minutes and agrees with Student's interval.
inline constexpr int most_bootstrapped = 1000;

/// Estimates a mean. The result is bitwise the same for any order of `values`. The bootstrap's random stream depends
/// only on `key` and n.
Estimate estimate(std::vector<double> values, std::uint64_t key);

/// t_{0.975, n−1} · sd / √n; nullopt for fewer than two values. Bitwise the same for any order of `values`.
std::optional<double> student_half_width(std::vector<double> values);

}  // namespace isojam
