#include "tasks/tables/stopping.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <utility>

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

/// Numbers of values, and their standard deviation, before `end`.
std::pair<int, double> spread(const Known& values, int end) {
  double sum = 0, squares = 0;
  int n = 0;
  for (int i = 0; i < end; ++i) {
    if (!values[static_cast<std::size_t>(i)]) continue;
    const double x = *values[static_cast<std::size_t>(i)];
    sum += x, squares += x * x, ++n;
  }
  return {n, std::sqrt((squares - sum * sum / n) / (n - 1))};
}

/// Stein's half width over the values before `end`, from the standard deviation of those before `first`.
double half_width(const Known& values, int first, int end) {
  const auto [m, sd] = spread(values, first);
  return boost::math::quantile(boost::math::students_t(m - 1), 0.975) * sd / std::sqrt(spread(values, end).first);
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
    while (expected < 40 && half_width(values, 4, expected) > asked.goal->half_width)
      expected = next_batch_end(expected, 40);
    const bool met = half_width(values, 4, expected) <= asked.goal->half_width;
    const auto advance = advance_of(asked, values);
    EXPECT_TRUE(advance.finished);
    EXPECT_EQ(advance.wanted, expected) << seed;
    EXPECT_EQ(advance.met, met) << seed;
    EXPECT_NEAR(*advance.half_width, half_width(values, 4, expected), 1e-12 * *advance.half_width);
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

TEST(Stopping, EqualValuesOfAProportionMeetNoGoal) {
  const Replicates rule{8, 40, Goal{"percolates", 0.1}};
  const auto advance = advance_of(rule, Known(8, 1.0));
  EXPECT_FALSE(advance.met);
  EXPECT_NEAR(*advance.half_width, 0.1622, 1e-4);
  const auto later = advance_of(rule, Known(40, 1.0));
  EXPECT_TRUE(later.met);
  EXPECT_EQ(later.wanted, 18) << "the first check with a half width of at most 0.1";
}

TEST(Stopping, EqualValuesMeetNoGoal) {
  Known values(12, 3.0);
  EXPECT_FALSE(advance_of(rule(4, 12, 1), values).met) << "their spread is unknown";
  EXPECT_EQ(advance_of(rule(4, 12, 1), values).wanted, 12);
  values[4] = 3.5;
  const auto advance = advance_of(rule(4, 12, 1), values);
  EXPECT_TRUE(advance.met);
  EXPECT_EQ(advance.wanted, 6);
  EXPECT_EQ(advance.first.size(), 6U) << "the first check at which values differ";
}

}  // namespace
}  // namespace isojam
