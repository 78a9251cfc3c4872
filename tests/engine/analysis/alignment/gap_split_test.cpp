#include "engine/analysis/alignment/gap_split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

constexpr double upper = 0.3;

/// n angles from upper·10^−decades to upper; their logarithms are uniform.
std::vector<double> log_uniform(int n, double decades, RandomStream& random) {
  std::vector<double> angles;
  for (int k = 0; k < n; ++k) angles.push_back(upper * std::pow(10, -decades * (1 - random.uniform())));
  return angles;
}

std::vector<double> power_law(int n, double exponent, RandomStream& random) {
  std::vector<double> angles;
  for (int k = 0; k < n; ++k) angles.push_back(upper * std::pow(random.uniform(), 1 / exponent));
  return angles;
}

/// `low` very small angles, and `high` angles that are uniform up to twice the window.
std::vector<double> two_groups(int low, int high, RandomStream& random) {
  std::vector<double> angles;
  for (int k = 0; k < low; ++k) angles.push_back(std::pow(10, -8 + 3 * random.uniform()));
  for (int k = 0; k < high; ++k) angles.push_back(0.02 + 2 * upper * random.uniform());
  return angles;
}

/// η of the split of the sorted logarithms before position k, computed from its definition.
double separation(const std::vector<double>& x, std::size_t k) {
  const auto mean = [&](std::size_t from, std::size_t to) {
    long double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += x[i];
    return sum / static_cast<long double>(to - from);
  };
  const long double all = mean(0, x.size()), low = mean(0, k), high = mean(k, x.size());
  long double variance = 0;
  for (const double value : x) variance += (value - all) * (value - all);
  const auto below = static_cast<long double>(k), above = static_cast<long double>(x.size() - k);
  return static_cast<double>(below * above / (below + above) * (high - low) * (high - low) / variance);
}

TEST(GapSplit, IsTheBestOfAllSplits) {
  RandomStream random{41};
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 10 + static_cast<int>(100 * random.uniform());
    const std::vector<double> angles = trial % 3 == 0   ? log_uniform(n, 4, random)
                                       : trial % 3 == 1 ? power_law(n, 1, random)
                                                        : two_groups(n, n, random);
    const GapSplit split = split_at_gap(angles, upper, {.quantile = -100});  // every split is a gap
    ASSERT_EQ(split.verdict, GapVerdict::separated);
    std::vector<double> x;
    for (const double angle : angles) {
      if (angle < upper) x.push_back(std::log(angle));
    }
    std::sort(x.begin(), x.end());
    double best = 0;
    for (std::size_t k = 1; k < x.size(); ++k) best = std::max(best, separation(x, k));
    EXPECT_NEAR(split.separation, best, 1e-12);
    EXPECT_NEAR(split.separation, separation(x, split.below), 1e-12);
    EXPECT_NEAR(std::log(split.cutoff), (x[split.below - 1] + x[split.below]) / 2, 1e-12);
    const auto below = std::count_if(angles.begin(), angles.end(), [&](double angle) { return angle < split.cutoff; });
    EXPECT_EQ(below, split.below);
  }
}

struct Scatter {
  double mean = 0, sd = 0;
  int separated = 0;
};

template <class Draw>
Scatter scatter(int sets, const Draw& draw) {
  double sum = 0, squares = 0;
  Scatter result;
  for (int set = 0; set < sets; ++set) {
    const GapSplit split = split_at_gap(draw(), upper);
    sum += split.separation;
    squares += split.separation * split.separation;
    result.separated += split.verdict == GapVerdict::separated;
  }
  result.mean = sum / sets;
  result.sd = std::sqrt(squares / sets - result.mean * result.mean);
  return result;
}

TEST(GapSplit, SeparationWithoutAGapHasTheKnownMean) {
  RandomStream random{42};
  constexpr int sets = 1000;
  for (const int n : {20, 60, 200, 1000}) {
    for (const double exponent : {0.3, 1.0, 3.0}) {
      const Scatter s = scatter(sets, [&] { return power_law(n, exponent, random); });
      EXPECT_NEAR(s.mean, 0.6476, 1.0 / std::sqrt(n)) << n;
      EXPECT_LE(s.separated, (n < 50 ? 0.1 : 0.02) * sets) << "power law, n " << n << ", exponent " << exponent;
    }
    const Scatter s = scatter(sets, [&] { return log_uniform(n, 5, random); });
    std::printf("n %4d, even over decades: η %.4f ± %.4f (%.4f expected), separated %.3f\n", n, s.mean, s.sd,
                std::sqrt(0.075 / n), s.separated / static_cast<double>(sets));
    // η of the best split is larger than that of the split in the middle, by the order of 1/n.
    EXPECT_NEAR(s.mean, 0.75, 5 * std::sqrt(0.075 / n / sets) + 0.5 / n) << n;
    EXPECT_NEAR(s.sd / std::sqrt(0.075 / n), 1, 0.1) << n;
    EXPECT_LE(s.separated, 0.1 * sets) << n;
    EXPECT_GE(s.separated, 0.02 * sets) << "the bound is no wider than it says; n " << n;
  }
}

TEST(GapSplit, GroupsDecadesApartAreSeparated) {
  RandomStream random{43};
  for (const int low : {8, 20, 60, 300}) {
    for (int trial = 0; trial < 50; ++trial) {
      const GapSplit split = split_at_gap(two_groups(low, 300, random), upper);
      ASSERT_EQ(split.verdict, GapVerdict::separated) << low << ", η " << split.separation << " of " << split.critical;
      EXPECT_EQ(split.below, low);
    }
  }
}

TEST(GapSplit, OneGroupIsAllAlike) {
  for (const double at : {0.0, 1e-15, 1e-9, 1e-3, 0.1}) {
    const GapSplit split = split_at_gap(std::vector<double>(40, at), upper);
    EXPECT_EQ(split.verdict, GapVerdict::all_alike) << at;
    EXPECT_GT(split.cutoff, at);
    EXPECT_LT(split.cutoff, upper);
    EXPECT_EQ(split.below, 40);
    EXPECT_EQ(split.separation, 0);
  }
  RandomStream random{44};
  std::vector<double> narrow;
  for (int k = 0; k < 100; ++k) narrow.push_back(1e-10 * (1 + 9 * random.uniform()));
  EXPECT_EQ(split_at_gap(narrow, upper).verdict, GapVerdict::all_alike);
  // Two different values have only one split.
  std::vector<double> two(15, 0.0);
  two.insert(two.end(), 15, 0.2);
  const GapSplit split = split_at_gap(two, upper);
  EXPECT_EQ(split.verdict, GapVerdict::separated);
  EXPECT_EQ(split.below, 15);
  EXPECT_NEAR(split.separation, 1, 1e-12);
}

TEST(GapSplit, FewAnglesAreTooFew) {
  EXPECT_EQ(GapSplit().verdict, GapVerdict::not_called);
  for (const int n : {0, 1, 9, 10}) {
    std::vector<double> angles(n, 1e-6);
    angles.insert(angles.end(), 50, upper);
    const GapSplit split = split_at_gap(angles, upper);
    EXPECT_EQ(split.verdict, n < 10 ? GapVerdict::too_few : GapVerdict::all_alike) << n;
    EXPECT_EQ(split.cutoff > 0, n >= 10);
  }
}

TEST(GapSplit, OrderAndUnitDoNotMatter) {
  RandomStream random{45};
  std::vector<double> angles = two_groups(30, 200, random);
  const GapSplit split = split_at_gap(angles, upper);
  std::reverse(angles.begin(), angles.end());
  EXPECT_EQ(split_at_gap(angles, upper).separation, split.separation);
  for (double& angle : angles) angle *= 4;
  const GapSplit scaled = split_at_gap(angles, 4 * upper);
  EXPECT_EQ(scaled.below, split.below);
  EXPECT_NEAR(scaled.cutoff, 4 * split.cutoff, 1e-12 * scaled.cutoff);
  EXPECT_NEAR(scaled.separation, split.separation, 1e-12);
}

TEST(GapSplit, RejectsInvalidAngles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(split_at_gap(std::vector<double>{0.1, nan}, upper), std::invalid_argument);
  EXPECT_THROW(split_at_gap(std::vector<double>{-0.1}, upper), std::invalid_argument);
  EXPECT_THROW(split_at_gap({}, 0), std::invalid_argument);
  EXPECT_THROW(split_at_gap({}, upper, {.resolution = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
