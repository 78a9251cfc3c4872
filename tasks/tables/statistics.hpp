#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/names/enum_names.hpp"

namespace isojam {

struct Interval {
  double low = 0, high = 0;
};

/// Methods for 95 % confidence intervals of a mean. docs/results.md states how often each interval contains the
/// mean.
enum class IntervalMethod : std::uint8_t {
  student,  ///< Student's t; the number of values is fixed in advance
  stein,    ///< stein_half_width(); the stopping rule chose the number of values
  wilson    ///< wilson(); each value is 0 or 1
};
template <>
inline constexpr std::array enum_names<IntervalMethod>{EnumName{IntervalMethod::student, "student"},
                                                       EnumName{IntervalMethod::stein, "stein"},
                                                       EnumName{IntervalMethod::wilson, "wilson"}};

/// Mean over replicates, and its uncertainty. sd, half_width and both intervals are nullopt for fewer than two values.
struct Estimate {
  int n = 0;
  std::optional<double> mean;        ///< nullopt if n = 0
  std::optional<double> sd;          ///< standard deviation of the sample, n − 1 degrees of freedom
  std::optional<double> half_width;  ///< half of the width of ci95
  std::optional<Interval> ci95;      ///< 95 % confidence interval of the mean, by `method`
  /// 95 % bootstrap interval: percentiles of Student's t of resamples. nullopt for proportions, for too few or too many
  /// values, and if equal values make the percentiles infinite.
  std::optional<Interval> bootstrap95;
  IntervalMethod method = IntervalMethod::student;
};

/// Number of resamples of a bootstrap.
inline constexpr int bootstrap_resamples = 2000;
/// Smallest number of values for which a bootstrap interval is computed: of fewer values, there are too few different
/// resamples.
inline constexpr int least_bootstrapped = 8;
/// Largest number of values for which a bootstrap interval is computed. For more values, the bootstrap takes minutes
/// and its interval agrees with Student's.
inline constexpr int most_bootstrapped = 1000;

/// Estimates the mean of `values`, with Student's interval. The result has the same bits for any order of `values`. The
/// random numbers of the bootstrap depend only on `key` and the number of values.
Estimate estimate(std::vector<double> values, std::uint64_t key);

/// Estimates the mean of values in groups. `means` are the means of the groups, and `sizes` their numbers of values.
/// There must be a group. The standard deviation is estimated from the groups, and Student's t has one degree of
/// freedom less than there are groups. There is no bootstrap interval.
Estimate estimate_of_groups(const std::vector<double>& means, const std::vector<int>& sizes);

/// Estimates a proportion, with Wilson's interval. Each value is 0 or 1, or is interpolated between them.
Estimate proportion_estimate(std::vector<double> values);

/// half_width of estimate(). The result has the same bits for any order of `values`.
std::optional<double> student_half_width(std::vector<double> values);

/// √n times stein_half_width().
std::optional<double> stein_scale(std::vector<double> first);

/// Half width of Stein's 95 % confidence interval of the mean of n values: t_{0.975, m−1} · s / √n, where s is the
/// standard deviation of the first m values. Let the values be normally distributed, and let n depend only on s. The
/// interval then contains the true mean with a probability of exactly 95 %, because for every n, the mean of n values
/// is independent of s (C. Stein, Ann. Math. Stat. 16, 243 (1945)). nullopt if m < 2. The result has the same bits for
/// any order of `first`; it equals student_half_width() if n = m.
std::optional<double> stein_half_width(std::vector<double> first, std::size_t n);

/// Replaces the interval of `estimate` by Stein's.
void use_stein(Estimate& estimate, const std::vector<double>& first);

/// Wilson's 95 % confidence interval of a proportion `share` in n ≥ 1 values (E. B. Wilson, J. Am. Stat. Assoc. 22, 209
/// (1927)).
Interval wilson(double share, std::size_t n);

}  // namespace isojam
