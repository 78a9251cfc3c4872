#include "engine/analysis/power_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

TEST(PowerLawTest, RecoversExactLaws) {
  RandomStream random{101};
  for (int trial = 0; trial < 100; ++trial) {
    const double exponent = 12 * random.uniform() - 6, prefactor = std::pow(10, 6 * random.uniform() - 3);
    std::vector<double> x, y;
    for (int k = 0; k < 8; ++k) {
      x.push_back(std::pow(10, -3 * random.uniform()));
      y.push_back(prefactor * std::pow(x.back(), exponent));
    }
    const auto law = fit_power_law(x, y);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, exponent, 1e-12);
    EXPECT_NEAR(law->prefactor, prefactor, 1e-11 * prefactor);
    EXPECT_LE(law->ci95_half_width, 1e-12);
    EXPECT_EQ(law->points, 8);
  }
}

TEST(PowerLawTest, NinetyFivePercentOfTheIntervalsContainTheExponent) {
  RandomStream random{102};
  const int trials = 4000;
  int held = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> x, y;
    for (int k = 0; k < 5; ++k) {
      x.push_back(std::exp(-k));
      y.push_back(std::exp(-4.0 * k + 0.3 * random.normal()));
    }
    const auto law = fit_power_law(x, y);
    held += std::abs(law->exponent - 4) <= law->ci95_half_width;
  }
  // Three standard deviations of a binomial distribution.
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 3 * std::sqrt(0.95 * 0.05 / trials));
}

TEST(PowerLawTest, IgnoresPointsThatAreNotPositive) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<double> x{1, 2, -1, 0, 3, nan, inf}, y{1, 4, 1, 1, -2, 1, 1};
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law);
  EXPECT_EQ(law->points, 2);
  EXPECT_NEAR(law->exponent, 2, 1e-14);
  EXPECT_EQ(law->ci95_half_width, 0);
}

TEST(PowerLawTest, EqualXGiveNoResult) {
  EXPECT_FALSE(fit_power_law({}, {}));
  EXPECT_FALSE(fit_power_law(std::vector{1.0}, std::vector{1.0}));
  EXPECT_FALSE(fit_power_law(std::vector{2.0, 2.0}, std::vector{1.0, 3.0}));
  EXPECT_THROW(fit_power_law(std::vector{2.0, 3.0}, std::vector{1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
