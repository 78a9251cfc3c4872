// Properties tested here:
// - Batches grow by a quarter, but by at least two, and never exceed max.
// - The rule stops at the first batch whose interval is narrow enough, according to an independent calculation. A
//   failed replicate counts without a value. Without a goal, all replicates are requested.
// - Values beyond those that the rule requests change nothing, so further records do not matter.
// - For samples of a normal distribution, the interval at which the rule stops contains the mean almost as often as
//   stated.

#include "tasks/tables/stopping.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Known = std::vector<std::optional<double>>;

Replicates rule(int min, int max, double half_width) { return {min, max, Goal{"phi_j", half_width}}; }

Known normal_values(std::uint64_t seed, int n) {
  RandomStream random{seed, 3};
  Known values;
  for (int i = 0; i < n; ++i) values.emplace_back(random.normal());
  return values;
}

double half_width(const Known& values, int first) {
  double sum = 0, squares = 0;
  int n = 0;
  for (int i = 0; i < first; ++i) {
    if (!values[static_cast<std::size_t>(i)]) continue;
    const double x = *values[static_cast<std::size_t>(i)];
    sum += x, squares += x * x, ++n;
  }
  if (n < 2) return INFINITY;
  const double variance = (squares - sum * sum / n) / (n - 1);
  return boost::math::quantile(boost::math::students_t(n - 1), 0.975) * std::sqrt(variance / n);
}

TEST(Stopping, BatchesGrowAndEnd) {
  std::vector<int> ends{4};
  while (ends.back() < 40) ends.push_back(next_batch_end(ends.back(), 40));
  EXPECT_EQ(ends, (std::vector<int>{4, 6, 8, 10, 12, 15, 18, 22, 27, 33, 40}));
  EXPECT_EQ(next_batch_end(5, 6), 6);
}

TEST(Stopping, StopsAtTheFirstNarrowBatch) {
  int stopped_early = 0, went_on_to_the_end = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    auto values = normal_values(seed, 40);
    if (seed % 3 == 0) values[1].reset();
    const auto asked = rule(4, 40, 0.2 + 0.01 * static_cast<double>(seed % 50));
    int expected = 4;
    while (expected < 40 && half_width(values, expected) > asked.goal->half_width)
      expected = next_batch_end(expected, 40);
    const bool met = half_width(values, expected) <= asked.goal->half_width;
    const auto advance = advance_of(asked, values);
    EXPECT_TRUE(advance.finished);
    EXPECT_EQ(advance.wanted, expected) << seed;
    EXPECT_EQ(advance.met, met) << seed;
    EXPECT_NEAR(*advance.half_width, half_width(values, expected), 1e-12 * *advance.half_width);
    stopped_early += expected < 40;
    went_on_to_the_end += !met;
    // Values beyond the stopping point are not used, and missing ones are requested batch by batch.
    for (int n = 0; n < expected; ++n) {
      const auto so_far = advance_of(asked, std::span(values).first(static_cast<std::size_t>(n)));
      EXPECT_FALSE(so_far.finished) << seed << " with " << n;
      EXPECT_GT(so_far.wanted, n);
      EXPECT_LE(so_far.wanted, expected);
    }
    const auto exact = advance_of(asked, std::span(values).first(static_cast<std::size_t>(expected)));
    EXPECT_EQ(exact.wanted, expected);
    EXPECT_TRUE(exact.finished);
  }
  EXPECT_GT(stopped_early, 50);
  EXPECT_GT(went_on_to_the_end, 5);
}

TEST(Stopping, WithoutAGoalAllAreRequested) {
  const Replicates all{7, 7, {}};
  EXPECT_EQ(advance_of(all, {}).wanted, 7);
  EXPECT_FALSE(advance_of(all, {}).finished);
  const auto done = advance_of(all, Known(7, 1.0));
  EXPECT_TRUE(done.finished);
  EXPECT_FALSE(done.met);
}

TEST(Stopping, FailuresAloneMeetNoGoal) {
  const auto advance = advance_of(rule(2, 6, 1), Known(6));
  EXPECT_TRUE(advance.finished);
  EXPECT_FALSE(advance.met);
  EXPECT_FALSE(advance.half_width);
  EXPECT_EQ(advance.wanted, 2) << "there is no hope where none of the first has a value";
  Known late(6);
  late[1] = 1.0;
  EXPECT_EQ(advance_of(rule(2, 6, 1), late).wanted, 6) << "one that has a value is hope";
}

TEST(Stopping, TheIntervalCoversTheMeanAboutAsOftenAsStated) {
  int covers = 0;
  constexpr int trials = 2000;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const auto values = normal_values(seed + 1000, 80);
    const auto advance = advance_of(rule(8, 80, 0.4), values);
    double sum = 0;
    for (int i = 0; i < advance.wanted; ++i) sum += *values[static_cast<std::size_t>(i)];
    covers += std::abs(sum / advance.wanted) <= *advance.half_width;
  }
  const double coverage = static_cast<double>(covers) / trials;
  std::printf("coverage of a nominal .95 interval at the stop: %.3f\n", coverage);
  EXPECT_GT(coverage, 0.90) << "looking often costs some coverage, but not much";
  EXPECT_LT(coverage, 0.97);
}

}  // namespace
}  // namespace isojam
