#include "engine/solve/jamming_point.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Law {
  double jamming = 0.68, prefactor = 1, exponent = 6;

  EnergyPoint at(double density) const {
    const double distance = density - jamming, energy = prefactor * std::pow(distance, exponent);
    return {density, energy, exponent * energy / distance};
  }
};

Law random_law(RandomStream& random, double exponent = 6) {
  return {uniform(random, 0.6, 0.8), decade(random, -2, 4), exponent};
}

/// n states in order of decreasing density. Their distances from φ_J decrease from `far` to far·ratio^(n−1).
std::vector<EnergyPoint> approach(const Law& law, int n, double far, double ratio) {
  std::vector<EnergyPoint> states;
  for (int k = 0; k < n; ++k) states.push_back(law.at(law.jamming + far * std::pow(ratio, k)));
  return states;
}

TEST(JammingPointTest, RecoversTheSixthPowerLaw) {
  RandomStream random{61};
  double worst = 0, worst_exponent = 0;
  for (int k = 0; k < 300; ++k) {
    const Law law = random_law(random);
    const int n = 3 + static_cast<int>(10 * random.uniform());
    const double ratio = uniform(random, 0.6, 0.9);
    const auto states = approach(law, n, 0.019, ratio);
    const auto point = fit_jamming_point(states, 0.02);
    ASSERT_TRUE(point);
    // Each density and each root has a rounding error. The extrapolation to zero amplifies it by the ratio of the
    // smallest distance to the range.
    const double rounding = 64 * eps * law.jamming / (1 - std::pow(ratio, n - 1));
    EXPECT_NEAR(point->density, law.jamming, rounding) << "n = " << n << ", ratio " << ratio;
    EXPECT_NEAR(point->single_state, law.jamming, 8 * eps) << "n = " << n;
    EXPECT_LT(point->standard_error, rounding);
    EXPECT_EQ(point->states.size(), static_cast<std::size_t>(n));
    worst = std::max(worst, std::abs(point->density - law.jamming));
    if (n < 4) {
      EXPECT_EQ(point->exponent, 0) << "three states can't fix an exponent";
    } else {
      EXPECT_NEAR(point->exponent, 6, 1e-5 * 6) << "n = " << n << ", ratio " << ratio;
      worst_exponent = std::max(worst_exponent, std::abs(point->exponent - 6));
    }
  }
  std::printf("worst errors: φ_J %.1e, exponent %.1e\n", worst, worst_exponent);
}

TEST(JammingPointTest, LeavesTheExponentFree) {
  RandomStream random{62};
  for (const double exponent : {4.5, 5.5, 6.5, 7.0}) {
    for (int k = 0; k < 40; ++k) {
      const Law law = random_law(random, exponent);
      const auto states = approach(law, 10, 0.018, uniform(random, 0.7, 0.85));
      const auto point = fit_jamming_point(states, 0.02);
      ASSERT_TRUE(point);
      EXPECT_NEAR(point->exponent, exponent, 1e-5 * exponent);
      // Fitting a line to a curve causes a visible error.
      EXPECT_GT(std::abs(point->density - law.jamming), 1e-6) << "exponent " << exponent;
      EXPECT_GT(point->standard_error, 1e-6) << "exponent " << exponent;
    }
  }
}

TEST(JammingPointTest, ErrorCoversScatter) {
  constexpr int trials = 4000;
  RandomStream random{63};
  for (const int n : {3, 5, 9}) {
    int covered = 0;
    double squares = 0, variances = 0;
    for (int k = 0; k < trials; ++k) {
      const Law law = random_law(random);
      auto states = approach(law, n, 0.018, 0.8);
      // The errors are much smaller than the distances between states, so neither the order nor the window changes.
      for (EnergyPoint& state : states) state.density += 1e-5 * random.normal();
      const auto point = fit_jamming_point(states, 0.02);
      ASSERT_TRUE(point);
      ASSERT_EQ(point->states.size(), static_cast<std::size_t>(n));
      const double error = point->density - law.jamming;
      covered += std::abs(error) <= point->ci95_half_width;
      squares += error * error;
      variances += point->standard_error * point->standard_error;
    }
    const double share = static_cast<double>(covered) / trials;
    std::printf("n = %d: the 95 %% interval covers %.1f %%, variance %.3f of the real one\n", n, 100 * share,
                variances / squares);
    // Four standard deviations of a binomial number, and of a ratio of two sums of squares.
    EXPECT_NEAR(share, 0.95, 4 * std::sqrt(0.95 * 0.05 / trials)) << "n = " << n;
    EXPECT_NEAR(variances / squares, 1, 4 * std::sqrt(2.0 / trials * (1 + 1.0 / (n - 2)))) << "n = " << n;
  }
}

TEST(JammingPointTest, ChoosesItsWindowByItsOwnAnswer) {
  RandomStream random{64};
  std::set<std::size_t> sizes;
  for (int k = 0; k < 400; ++k) {
    // Far states deviate from the sixth power, so the result depends on the window.
    const Law law = random_law(random);
    std::vector<EnergyPoint> states;
    const double bend = uniform(random, -2, 4);
    double distance = uniform(random, 0.08, 0.15);
    while (distance > uniform(random, 0.002, 0.03)) {
      states.push_back(law.at(law.jamming + distance));
      states.back().energy_per_particle *= 1 + bend * distance;
      distance *= uniform(random, 0.6, 0.9);
    }
    if (states.size() < 2) continue;
    const double window = decade(random, -2.3, -1);
    const auto point = fit_jamming_point(states, window);
    ASSERT_TRUE(point);
    std::vector<int> expected;
    for (int s = static_cast<int>(states.size()) - 1; s >= 0; --s) {
      const bool within = states[static_cast<std::size_t>(s)].density - point->density < window;
      if (within || expected.size() < 2) expected.push_back(s);
    }
    EXPECT_EQ(point->states, expected) << "case " << k << ": window " << window << ", φ_J " << point->density;
    sizes.insert(point->states.size());
  }
  EXPECT_GT(sizes.size(), 5U) << "windows should differ in what they hold";
}

TEST(JammingPointTest, NeedsTwoStates) {
  const Law law;
  EXPECT_FALSE(fit_jamming_point({}, 0.02));
  const std::vector<EnergyPoint> one{law.at(0.69)};
  EXPECT_FALSE(fit_jamming_point(one, 0.02));
  const std::vector<EnergyPoint> one_with_energy{law.at(0.69), {0.67, 0, 0}};
  EXPECT_FALSE(fit_jamming_point(one_with_energy, 0.02));
  // Both states are outside of the window and are still used.
  const std::vector<EnergyPoint> two{law.at(0.75), law.at(0.72)};
  const auto point = fit_jamming_point(two, 0.02);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->density, law.jamming, 64 * eps);
  EXPECT_EQ(point->standard_error, 0);
  EXPECT_EQ(point->ci95_half_width, 0);
  EXPECT_EQ(point->exponent, 0);
  EXPECT_EQ(point->states, (std::vector<int>{1, 0}));
}

}  // namespace
}  // namespace isojam
