#include "engine/analysis/alignment/trough.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "engine/analysis/alignment/angle_histogram.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

constexpr int window = 228;  // 10^−0.6 = 0.25 rad
constexpr double pi = 3.141592653589793;

using Counts = std::vector<double>;

double log10_of(int position) { return angle_bins_from + position / double{angle_bins_per_decade}; }

void count(Counts& counts, double log10_theta) {
  ++counts[static_cast<std::size_t>(angle_bin(std::pow(10, std::min(log10_theta, 0.4))))];
}

double normal(RandomStream& random) {
  return std::sqrt(-2 * std::log(1 - random.uniform())) * std::cos(2 * pi * random.uniform());
}

Counts uniform_in_log(int n, RandomStream& random) {
  Counts counts(angle_bins);
  for (int i = 0; i < n; ++i) count(counts, -0.6 - 8 * random.uniform());
  return counts;
}

/// n angles whose cumulative distribution is ∝ θ^exponent, up to 0.5 rad.
void add_power_law(Counts& counts, int n, double exponent, RandomStream& random) {
  for (int i = 0; i < n; ++i) count(counts, -0.3 + std::log10(1 - random.uniform()) / exponent);
}

void add_normal(Counts& counts, int n, double mean, double sd, RandomStream& random) {
  for (int i = 0; i < n; ++i) count(counts, mean + sd * normal(random));
}

double sum(const Counts& counts, int from, int to) {
  return std::accumulate(counts.begin() + from, counts.begin() + to, 0.0);
}

/// Share of random sets of angles whose excess is above its critical value.
template <class Draw>
double share_above_critical(int sets, const Draw& draw) {
  int above = 0;
  for (int set = 0; set < sets; ++set) {
    const Trough trough = find_trough(draw(), window);
    above += trough.excess > trough.critical;
  }
  return above / static_cast<double>(sets);
}

TEST(Trough, DensitiesWithoutATroughAreRarelyMisjudged) {
  RandomStream random{51};
  constexpr int sets = 600;
  double any = 0;
  for (const int n : {20, 100, 400, 2000}) {
    const double uniform = share_above_critical(sets, [&] { return uniform_in_log(n, random); });
    std::printf("n %4d: uniform %.3f", n, uniform);
    any += uniform;
    EXPECT_LE(uniform, 0.05) << n;
    for (const double exponent : {0.3, 0.65, 2.0}) {
      const double share = share_above_critical(sets, [&] {
        Counts counts(angle_bins);
        add_power_law(counts, n, exponent, random);
        return counts;
      });
      std::printf(", power law %.2f: %.3f", exponent, share);
      EXPECT_LE(share, 0.05) << n << ", exponent " << exponent;
    }
    std::printf("\n");
  }
  EXPECT_GT(any, 0.01) << "the criterion is not stricter than necessary by orders of magnitude";
}

TEST(Trough, EdgesEncloseTheTailsOfBothPopulations) {
  for (const double a : {0.3, 0.5, 1.0}) {
    constexpr double least = -4;
    constexpr double f_min = 1e4;
    Counts counts(angle_bins);
    for (int k = 120; k < window; ++k)
      counts[static_cast<std::size_t>(k)] =
          f_min / angle_bins_per_decade * std::cosh((log10_of(k) + 0.025 - least) / a);
    for (int k = 0; k < 120; ++k) counts[static_cast<std::size_t>(k)] = counts[120] * std::exp((k - 120) / 10.0);
    const Trough trough = find_trough(counts, window);
    ASSERT_EQ(trough.verdict, TroughVerdict::found) << a;
    EXPECT_NEAR(log10_of(trough.cutoff), least, 0.051) << a;
    const double edge = a * std::asinh(0.5);
    EXPECT_NEAR(log10_of(trough.low), least - edge, 0.051) << a;
    EXPECT_NEAR(log10_of(trough.high), least + edge, 0.051) << a;
    // The kernel widens exponential tails by the factor exp(h²/2a²), and changes no position.
    const double widened = std::exp(trough.kernel * trough.kernel / (2 * a * a));
    EXPECT_NEAR(trough.density, f_min * widened, 0.05 * f_min * widened) << a;
    const double tail = f_min * a / 2;
    EXPECT_NEAR(sum(counts, trough.low, trough.cutoff), tail, 0.051 * 1.2 * f_min) << a;
    EXPECT_NEAR(sum(counts, trough.cutoff, trough.high), tail, 0.051 * 1.2 * f_min) << a;
  }
}

/// Minimum of the density of `small` normal log10 θ and `large` angles of a power law.
double antimode(double small, double mean, double sd, double large, double exponent) {
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (double x = mean; x < -0.3; x += 0.001) {
    const double f = small * std::exp(-(x - mean) * (x - mean) / (2 * sd * sd)) / (sd * std::sqrt(2 * pi)) +
                     large * exponent * std::log(10.0) * std::pow(10, exponent * (x + 0.3));
    if (f < least) {
      least = f;
      best = x;
    }
  }
  return best;
}

TEST(Trough, IsNearTheKnownMinimumOfMixtures) {
  RandomStream random{52};
  constexpr int sets = 60;
  struct Case {
    int small, large;
    double mean, sd, allowed;
    int found;  ///< smallest number of sets with a trough
  };
  // Numbers of one packing of 100 particles, and of 16 such packings together.
  for (const Case& c :
       {Case{60, 350, -5, 0.4, 0.5, 40}, Case{960, 5600, -5, 0.5, 0.3, sets}, Case{960, 5600, -4, 0.5, 0.3, sets},
        Case{960, 5600, -3.5, 0.4, 0.3, sets}, Case{30, 350, -9, 1, 1.5, 55}}) {
    const double expected = antimode(c.small, c.mean, c.sd, c.large, 0.65);
    // The interquartile range of a power law is log10(3)/0.65; 1.34 is that of the normal distribution with sd 1.
    const double silverman =
        0.9 * std::max(c.sd * std::pow(c.small, -0.2), std::log10(3) / 0.65 / 1.34 * std::pow(c.large, -0.2));
    int found = 0;
    double mean = 0, squares = 0, below = 0, kernels = 0;
    for (int set = 0; set < sets; ++set) {
      Counts counts(angle_bins);
      add_normal(counts, c.small, c.mean, c.sd, random);
      add_power_law(counts, c.large, 0.65, random);
      const Trough trough = find_trough(counts, window);
      if (trough.verdict != TroughVerdict::found) continue;
      ++found;
      EXPECT_LE(log10_of(trough.low), log10_of(trough.cutoff));
      EXPECT_LE(log10_of(trough.cutoff), log10_of(trough.high));
      EXPECT_GT(trough.excess, trough.critical);
      mean += log10_of(trough.cutoff);
      squares += std::pow(log10_of(trough.cutoff) - expected, 2);
      below += sum(counts, 0, trough.cutoff) / c.small;
      kernels += trough.kernel;
    }
    std::printf("%d at %.1f, %d above: %d of %d found, at %.2f (%.2f expected, rms %.2f), %.3f of the small ones\n",
                c.small, c.mean, c.large, found, sets, mean / found, expected, std::sqrt(squares / found),
                below / found);
    EXPECT_GE(found, c.found) << c.mean;
    EXPECT_LT(std::sqrt(squares / found), c.allowed) << c.mean;
    EXPECT_NEAR(below / found, 1, 0.25) << c.mean;
    EXPECT_NEAR(kernels / found / silverman, 1, 0.2) << c.mean;
  }
}

TEST(Trough, EmptyTroughHasDepthOne) {
  Counts counts(angle_bins);
  for (int k = 40; k < 60; ++k) counts[static_cast<std::size_t>(k)] = 2;
  for (int k = 200; k < 245; ++k) counts[static_cast<std::size_t>(k)] = 9;
  const Trough trough = find_trough(counts, window);
  ASSERT_EQ(trough.verdict, TroughVerdict::found);
  EXPECT_NEAR(trough.depth, 1, 1e-9);
  EXPECT_EQ(sum(counts, 0, trough.cutoff), 40);
  const auto bins = static_cast<int>(std::ceil(2 * trough.kernel * angle_bins_per_decade));
  EXPECT_LE(trough.low, 60 + bins);
  EXPECT_GE(trough.high, 200 - bins);
}

TEST(Trough, OnePopulationHasNoTrough) {
  EXPECT_EQ(Trough().verdict, TroughVerdict::not_called);
  Counts counts(angle_bins);
  EXPECT_EQ(find_trough(counts, window).verdict, TroughVerdict::undecided) << "no angles";
  counts[30] = 200;
  EXPECT_EQ(find_trough(counts, window).verdict, TroughVerdict::undecided) << "only small angles";
  EXPECT_EQ(find_trough(counts, 0).verdict, TroughVerdict::undecided) << "no window";
  counts[240] = 500;
  EXPECT_EQ(find_trough(counts, 20).verdict, TroughVerdict::undecided) << "both populations above the window";
  const Trough trough = find_trough(counts, window);
  ASSERT_EQ(trough.verdict, TroughVerdict::found);
  EXPECT_GT(trough.cutoff, 30);
  EXPECT_LE(trough.high, window);
}

TEST(Trough, RejectsInvalidNumbers) {
  EXPECT_THROW(find_trough(Counts{1, -1}, 1), std::invalid_argument);
  EXPECT_THROW(find_trough(Counts{1, std::numeric_limits<double>::quiet_NaN()}, 1), std::invalid_argument);
  EXPECT_THROW(find_trough(Counts{1, 2}, 3), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
