#include "engine/arithmetic/elementary.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A random number of either sign, with a magnitude from 2^low to 2^high.
double of_any_size(RandomStream& random, int low, int high) {
  const double size = std::ldexp(1 + random.uniform(), low + static_cast<int>(random.uniform() * (high - low)));
  return random.uniform() < 0.5 ? -size : size;
}

struct Case {
  const char* name;
  double (*ours)(double);
  Exact (*exact)(const Exact&);
  double (*standard)(double);
  double lower, upper;  ///< ends of its domain
  int low, high;        ///< arguments have magnitudes from 2^low to 2^high
};

const Case cases[] = {
    {"sin", nearest::sin, [](const Exact& x) -> Exact { return sin(x); }, std::sin, -infinity, infinity, -60, 30},
    {"cos", nearest::cos, [](const Exact& x) -> Exact { return cos(x); }, std::cos, -infinity, infinity, -60, 30},
    {"tan", nearest::tan, [](const Exact& x) -> Exact { return tan(x); }, std::tan, -infinity, infinity, -60, 30},
    {"asin", nearest::asin, [](const Exact& x) -> Exact { return asin(x); }, std::asin, -1, 1, -60, 0},
    {"acos", nearest::acos, [](const Exact& x) -> Exact { return acos(x); }, std::acos, -1, 1, -60, 0},
    {"exp", nearest::exp, [](const Exact& x) -> Exact { return exp(x); }, std::exp, -700, 700, -60, 9},
    {"log", nearest::log, [](const Exact& x) -> Exact { return log(x); }, std::log, 0, infinity, -1000, 1000},
    {"log10", nearest::log10, [](const Exact& x) -> Exact { return log10(x); }, std::log10, 0, infinity, -1000, 1000},
    {"log1p", nearest::log1p, [](const Exact& x) -> Exact { return log1p(x); }, std::log1p, -1, infinity, -60, 60},
    {"cbrt", nearest::cbrt, [](const Exact& x) -> Exact { return cbrt(x); }, std::cbrt, -infinity, infinity, -900,
     900}};

class Nearest : public testing::TestWithParam<Case> {};

TEST_P(Nearest, IsTheNearestDouble) {
  const Case& function = GetParam();
  RandomStream random{7, hash_of(function.name)};
  int tried = 0;
  const auto check = [&](double x) {
    if (!(x > function.lower && x < function.upper)) return;
    ++tried;
    const auto exact = static_cast<double>(function.exact(Exact(x)));
    EXPECT_EQ(function.ours(x), exact) << function.name << "(" << x << ")";
  };
  for (int k = 0; k < 2000; ++k) check(of_any_size(random, function.low, function.high));
  for (int k = 1; k < 50; ++k) {
    for (const double near : {-1.0, 1.0, k * std::numbers::pi / 2}) check(near * (1 + std::ldexp(1.0, -k)));
    for (const double near : {-1.0, 1.0, k * std::numbers::pi / 2}) check(near * (1 - std::ldexp(1.0, -k)));
  }
  EXPECT_GT(tried, 900);
}

TEST_P(Nearest, SpecialValuesAreThoseOfTheStandardLibrary) {
  const Case& function = GetParam();
  for (const double x : {0.0, -0.0, infinity, -infinity, std::nan(""), 2.0, -2.0}) {
    const double ours = function.ours(x), standard = function.standard(x);
    if (std::isfinite(standard) && x != 0) continue;
    EXPECT_EQ(std::isnan(ours), std::isnan(standard)) << function.name << "(" << x << ")";
    if (std::isnan(standard)) continue;
    EXPECT_EQ(ours, standard) << function.name << "(" << x << ")";
    EXPECT_EQ(std::signbit(ours), std::signbit(standard)) << function.name << "(" << x << ")";
  }
}

INSTANTIATE_TEST_SUITE_P(Functions, Nearest, testing::ValuesIn(cases),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(NearestOfTwo, IsTheNearestDouble) {
  RandomStream random{11};
  for (int k = 0; k < 2000; ++k) {
    const double x = of_any_size(random, -40, 40), y = of_any_size(random, -40, 40);
    EXPECT_EQ(nearest::atan2(y, x), static_cast<double>(Exact(atan2(Exact(y), Exact(x))))) << y << ", " << x;
    const Exact square = Exact(x) * x + Exact(y) * y;
    EXPECT_EQ(nearest::hypot(x, y), static_cast<double>(Exact(sqrt(square)))) << x << ", " << y;
    const double power = of_any_size(random, -6, 4);
    EXPECT_EQ(nearest::pow(std::abs(x), power), static_cast<double>(Exact(pow(Exact(std::abs(x)), Exact(power)))))
        << x << ", " << power;
  }
  EXPECT_EQ(nearest::atan2(0.0, -1.0), std::numbers::pi);
  EXPECT_EQ(nearest::atan2(-0.0, -1.0), -std::numbers::pi);
  EXPECT_EQ(nearest::pow(-3, 3), -27);
  EXPECT_EQ(nearest::pow(0, 0.2), 0);
}

TEST(Sinc, IsRightToTwoEpsilon) {
  RandomStream random{13};
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    const double x = k < 4000 ? 2 * random.uniform() - 1 : 20 * random.uniform() - 10;
    const Exact exact = sin(Exact(x)) / x;
    worst = std::max(worst, static_cast<double>(Exact(abs(sinc(x) / exact - 1))));
    EXPECT_EQ(sinc(x), sinc(-x)) << x;
  }
  EXPECT_LT(worst, 2 * std::numeric_limits<double>::epsilon());
  EXPECT_EQ(sinc(0), 1);
  EXPECT_EQ(sinc(1e-300), 1);
}

}  // namespace
}  // namespace isojam
