#include "tasks/tables/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/arithmetic/distributions.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

std::vector<double> normal_sample(RandomStream& random, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(random.normal());
  return values;
}

TEST(Estimate, FollowsTheDefinition) {
  struct Tabulated {
    int n;
    double t;
  };
  RandomStream random{3};
  for (const auto& [n, t] : {Tabulated{2, 12.706}, {3, 4.303}, {4, 3.182}, {5, 2.776}, {11, 2.228}, {31, 2.042}}) {
    const auto values = normal_sample(random, n);
    double sum = 0, squares = 0;
    for (const double x : values) sum += x;
    for (const double x : values) squares += (x - sum / n) * (x - sum / n);
    const double sd = std::sqrt(squares / (n - 1));
    const auto result = estimate(values, 1);
    EXPECT_EQ(result.n, n);
    EXPECT_NEAR(*result.mean, sum / n, 1e-14 * sd);
    EXPECT_NEAR(*result.sd, sd, 1e-13 * sd);
    EXPECT_NEAR(*result.half_width, t * sd / std::sqrt(n), 6e-4 / t * *result.half_width) << n;
    EXPECT_EQ(result.ci95->low, *result.mean - *result.half_width);
    EXPECT_EQ(result.ci95->high, *result.mean + *result.half_width);
  }
}

TEST(Estimate, WithoutSpreadThereIsNoInterval) {
  const auto none = estimate({}, 1);
  EXPECT_EQ(none.n, 0);
  EXPECT_FALSE(none.mean || none.sd || none.half_width || none.ci95 || none.bootstrap95);
  const auto one = estimate({2.5}, 1);
  EXPECT_EQ(one.n, 1);
  EXPECT_EQ(one.mean, 2.5);
  EXPECT_FALSE(one.sd || one.half_width || one.ci95 || one.bootstrap95);
}

/// Percentages of samples of n values whose intervals contain the mean of the distribution.
struct Coverage {
  double student = 0, bootstrap = 0;
};

constexpr int samples = 2000;

Coverage coverage_of(const std::function<double(RandomStream&)>& value, double mean, int n, const char* name) {
  RandomStream random{6, static_cast<std::uint64_t>(n)};
  Coverage coverage;
  for (int k = 0; k < samples; ++k) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(value(random));
    const auto result = estimate(values, static_cast<std::uint64_t>(k));
    const auto contains = [&](const Interval& interval) { return interval.low <= mean && mean <= interval.high; };
    coverage.student += 100.0 / samples * contains(*result.ci95);
    if (result.bootstrap95) coverage.bootstrap += 100.0 / samples * contains(*result.bootstrap95);
  }
  std::printf("%s, n = %d: Student %.1f %%, bootstrap %.1f %%\n", name, n, coverage.student, coverage.bootstrap);
  return coverage;
}

double exponential(RandomStream& random) { return -std::log(1 - random.uniform()); }
double lognormal(RandomStream& random) { return std::exp(random.normal()); }

/// Three and a half standard errors of a simulated coverage of 95 %, in percent.
const double uncertainty = 350 * std::sqrt(0.95 * 0.05 / samples);

TEST(Estimate, IntervalsContainTheMeanAsOftenAsStated) {
  for (const int n : {2, 3, 4, 6, 8, 16}) {
    const auto normal = coverage_of([](RandomStream& random) { return random.normal(); }, 0, n, "normal");
    EXPECT_NEAR(normal.student, 95, uncertainty) << n;
    EXPECT_NEAR(normal.bootstrap, n >= least_bootstrapped ? 95 : 0, uncertainty) << n;
  }
}

TEST(Estimate, BootstrapFollowsItsDefinition) {
  RandomStream values_of{8};
  const auto values = normal_sample(values_of, 12);
  const auto result = estimate(values, 5);
  auto sorted = values;
  std::sort(sorted.begin(), sorted.end());
  RandomStream random{5, 12, static_cast<std::uint64_t>(Purpose::bootstrap)};
  std::vector<double> ratios;
  for (int k = 0; k < bootstrap_resamples; ++k) {
    std::vector<double> resample;
    for (int i = 0; i < 12; ++i) resample.push_back(sorted[static_cast<std::size_t>(12 * random.uniform())]);
    const auto of_resample = estimate(resample, 0);
    ratios.push_back((*of_resample.mean - *result.mean) / *of_resample.sd);
  }
  std::sort(ratios.begin(), ratios.end());
  const auto percentile = [&](double p) {
    const double at = p * (bootstrap_resamples - 1), whole = std::floor(at);
    const double* value = &ratios[static_cast<std::size_t>(whole)];
    return std::lerp(value[0], value[1], at - whole);
  };
  EXPECT_NEAR(result.bootstrap95->low, *result.mean - percentile(0.975) * *result.sd, 1e-12 * *result.sd);
  EXPECT_NEAR(result.bootstrap95->high, *result.mean - percentile(0.025) * *result.sd, 1e-12 * *result.sd);
}

TEST(Estimate, BootstrapSuitsSkewedValues) {
  for (const int n : {8, 16}) {
    const auto skewed = coverage_of(exponential, 1, n, "exponential");
    EXPECT_GT(skewed.bootstrap, skewed.student + 1) << n;
    EXPECT_GT(skewed.bootstrap, 92) << n;
    const auto very_skewed = coverage_of(lognormal, std::exp(0.5), n, "lognormal");
    EXPECT_GT(very_skewed.bootstrap, very_skewed.student + 2) << n;
  }
}

TEST(Estimate, BootstrapNeedsEnoughDifferentValues) {
  RandomStream random{9};
  for (const int n : {2, 4, 7, 8, 1000, 1001}) {
    const auto values = normal_sample(random, n);
    EXPECT_EQ(estimate(values, 1).bootstrap95.has_value(), n >= 8 && n <= 1000) << n;
  }
  std::vector<double> values(16, 0.5);
  EXPECT_FALSE(estimate(values, 1).bootstrap95) << "equal values have no spread";
  values[3] = 0.75;
  EXPECT_FALSE(estimate(values, 1).bootstrap95) << "many resamples have no spread";
}

TEST(Estimate, SteinsIntervalUsesTheSpreadOfTheFirstValues) {
  RandomStream random{10};
  auto values = normal_sample(random, 24);
  const std::vector<double> first(values.begin(), values.begin() + 8);
  EXPECT_EQ(stein_half_width(first, 8), student_half_width(first));
  auto result = estimate(values, 1);
  const auto student = result;
  use_stein(result, first);
  EXPECT_EQ(result.method, IntervalMethod::stein);
  EXPECT_NEAR(*result.half_width, *student_half_width(first) / std::sqrt(3), 1e-15 * *result.half_width);
  EXPECT_NE(*result.half_width, *student.half_width);
  EXPECT_EQ(result.ci95->high, *result.mean + *result.half_width);
  EXPECT_EQ(*result.mean, *student.mean);
  EXPECT_EQ(*result.sd, *student.sd);
  EXPECT_FALSE(stein_half_width({1.0}, 8));
}

TEST(Estimate, IntervalsOfGroupsContainTheMeanAsOftenAsStated) {
  RandomStream random{21};
  int inside = 0;
  double variance = 0;
  for (int i = 0; i < samples; ++i) {
    std::vector<double> means;
    std::vector<int> sizes;
    for (int size = 1; size <= 6; ++size) {
      means.push_back(random.normal() / std::sqrt(size));
      sizes.push_back(size);
    }
    const auto result = estimate_of_groups(means, sizes);
    EXPECT_EQ(result.n, 21);
    inside += result.ci95->low <= 0 && 0 <= result.ci95->high;
    variance += *result.sd * *result.sd / samples;
  }
  EXPECT_NEAR(100.0 * inside / samples, 95, uncertainty);
  EXPECT_NEAR(variance, 1, 0.05);
  const auto alone = estimate_of_groups({2}, {9});
  EXPECT_EQ(*alone.mean, 2);
  EXPECT_FALSE(alone.half_width);
}

TEST(Estimate, WilsonsIntervalAgreesWithPublishedValues) {
  struct Published {
    int successes, n;
    double low, high;
  };
  // R. G. Newcombe, Stat. Med. 17, 857 (1998), Table I, method 3.
  for (const auto& [successes, n, low, high] :
       {Published{81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0, 0.1611}, {1, 29, 0.0061, 0.1718}}) {
    std::vector<double> values(static_cast<std::size_t>(n), 0.0);
    std::fill_n(values.begin(), successes, 1.0);
    const auto result = proportion_estimate(values);
    EXPECT_EQ(result.method, IntervalMethod::wilson);
    EXPECT_NEAR(result.ci95->low, low, 5e-5);
    EXPECT_NEAR(result.ci95->high, high, 5e-5);
    EXPECT_EQ(*result.half_width, (result.ci95->high - result.ci95->low) / 2);
    EXPECT_FALSE(result.bootstrap95);
  }
  EXPECT_FALSE(proportion_estimate({1}).ci95);
  EXPECT_GT(*proportion_estimate({1, 1, 1, 1}).half_width, 0.2) << "four equal values do not determine a proportion";
}

}  // namespace
}  // namespace isojam
