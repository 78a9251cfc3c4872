// Properties tested here:
// - Mean, standard deviation and half width follow from their definitions; Student's t agrees with tables in textbooks.
// - The order of the values changes no bit.
// - With one value or none, there is no interval.
// - The t interval contains the true mean with the stated probability. The bootstrap interval does so for many values,
//   and less often for few values, as expected.
// - The bootstrap interval depends only on its key and the values.

#include "tasks/tables/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(Estimate, OrderChangesNoBit) {
  RandomStream random{4};
  for (int trial = 0; trial < 20; ++trial) {
    auto values = normal_sample(random, 3 + trial);
    const auto first = estimate(values, 5);
    std::shuffle(values.begin(), values.end(), std::mt19937_64(static_cast<unsigned>(trial)));
    const auto second = estimate(values, 5);
    EXPECT_EQ(*first.mean, *second.mean);
    EXPECT_EQ(*first.sd, *second.sd);
    EXPECT_EQ(first.bootstrap95->low, second.bootstrap95->low);
    EXPECT_EQ(first.bootstrap95->high, second.bootstrap95->high);
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

TEST(Estimate, CoverageIsAsStated) {
  struct Expected {
    int n;
    double bootstrap_low, bootstrap_high;
  };
  constexpr int trials = 2000;
  const double error = std::sqrt(0.95 * 0.05 / trials);
  for (const auto& [n, low, high] : {Expected{4, 0.70, 0.90}, {40, 0.90, 0.96}}) {
    RandomStream random{6, static_cast<std::uint64_t>(n)};
    int by_t = 0, by_bootstrap = 0;
    for (int trial = 0; trial < trials; ++trial) {
      const auto result = estimate(normal_sample(random, n), static_cast<std::uint64_t>(trial));
      by_t += result.ci95->low < 0 && 0 < result.ci95->high;
      by_bootstrap += result.bootstrap95->low < 0 && 0 < result.bootstrap95->high;
    }
    EXPECT_NEAR(by_t / double(trials), 0.95, 3.5 * error) << "n = " << n;
    EXPECT_GT(by_bootstrap / double(trials), low) << "n = " << n;
    EXPECT_LT(by_bootstrap / double(trials), high) << "n = " << n;
  }
}

TEST(Estimate, BootstrapDependsOnlyOnKeyAndValues) {
  RandomStream random{8};
  const auto values = normal_sample(random, 10);
  EXPECT_EQ(estimate(values, 1).bootstrap95->low, estimate(values, 1).bootstrap95->low);
  EXPECT_NE(estimate(values, 1).bootstrap95->low, estimate(values, 2).bootstrap95->low);
}

}  // namespace
}  // namespace isojam
