#include "engine/analysis/alignment/cdf_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "engine/random/stream.hpp"

namespace isojam {
namespace {

using Matrix4l = Eigen::Matrix<long double, 4, 4>;
using Vector4l = Eigen::Matrix<long double, 4, 1>;

constexpr double upper = 0.3;

/// n angles. A fraction f is spread over several decades up to 1e-3; the rest is uniform up to `top`.
std::vector<double> mixture(int n, double f, double top, RandomStream& random) {
  std::vector<double> angles;
  const int ultra_low = static_cast<int>(std::lround(f * n));
  for (int k = 0; k < n; ++k) {
    angles.push_back(k < ultra_low ? std::pow(10, -9 + 6 * random.uniform()) : top * random.uniform());
  }
  return angles;
}

/// Sets of angles of different kinds: few and many, with and without a jump, with a curved CDF, in clumps, with a gap.
std::vector<std::vector<double>> families(RandomStream& random) {
  std::vector<std::vector<double>> sets;
  for (const int n : {8, 40, 300}) {
    sets.push_back(mixture(n, 0.2, 1, random));
    sets.push_back(mixture(n, 0, 0.5, random));
    std::vector<double> bent, clumps, gap;
    for (int k = 0; k < n; ++k) {
      bent.push_back(std::pow(random.uniform(), 3));
      clumps.push_back(0.05 * std::floor(8 * random.uniform()) + 1e-3 * random.uniform());
      gap.push_back(k % 3 == 0 ? 0.05 + 0.001 * random.uniform() : 0.2 + random.uniform());
    }
    sets.push_back(bent);
    sets.push_back(clumps);
    sets.push_back(gap);
  }
  return sets;
}

/// The error ∫ (c_f − c)² dθ as a quadratic form in the coefficients a, from integrals of powers of θ − α.
class Oracle {
 public:
  Oracle(std::vector<double> angles, double alpha) {
    std::sort(angles.begin(), angles.end());
    long double from = 0;
    for (std::size_t k = 0; k <= angles.size() && from < upper; ++k) {
      const long double to = k < angles.size() ? std::min(angles[k], upper) : upper;
      add(from, to, static_cast<long double>(k) / static_cast<long double>(angles.size()), alpha);
      from = std::max(from, to);
    }
  }

  long double error(const Vector4l& a) const { return a.dot(quadratic_ * a) - 2 * linear_.dot(a) + constant_; }
  Vector4l best() const { return quadratic_.fullPivLu().solve(linear_); }

 private:
  void add(long double from, long double to, long double height, long double alpha) {
    constant_ += height * height * (to - from);
    from = std::max(from, alpha);
    if (to <= from) return;
    long double power[7], high = to - alpha, low = from - alpha;  // integrals of (θ − α)^n
    for (int n = 0; n < 7; ++n, high *= to - alpha, low *= from - alpha) power[n] = (high - low) / (n + 1);
    for (int i = 0; i < 4; ++i) {
      const int sign_i = i == 0 ? 1 : -1;
      linear_[i] += sign_i * height * power[i];
      for (int j = 0; j < 4; ++j) quadratic_(i, j) += sign_i * (j == 0 ? 1 : -1) * power[i + j];
    }
  }

  Matrix4l quadratic_ = Matrix4l::Zero();
  Vector4l linear_ = Vector4l::Zero();
  long double constant_ = 0;
};

Vector4l coefficients(const CdfFit& fit) { return {fit.a[0], fit.a[1], fit.a[2], fit.a[3]}; }

TEST(CdfFit, NoOtherCoefficientsAreBetter) {
  RandomStream random{15};
  for (const std::vector<double>& angles : families(random)) {
    const CdfFit fit = fit_cdf(angles, upper);
    if (fit.verdict == FitVerdict::too_few) continue;
    const Oracle oracle(angles, fit.alpha);
    const Vector4l a = coefficients(fit);
    EXPECT_NEAR(fit.error, static_cast<double>(oracle.error(a)), 1e-9 * fit.error) << angles.size() << " angles";
    for (int n = 0; n < 4; ++n) {
      for (const long double change : {-1e-3L, 1e-3L}) {
        Vector4l other = a;
        other[n] += change * std::pow(upper, -static_cast<long double>(n));
        EXPECT_GT(oracle.error(other), fit.error) << "a_" << n << ", " << angles.size() << " angles";
      }
    }
  }
}

TEST(CdfFit, NoOtherAlphaIsBetter) {
  RandomStream random{16};
  for (const std::vector<double>& angles : families(random)) {
    const CdfFit fit = fit_cdf(angles, upper);
    if (fit.verdict == FitVerdict::too_few) continue;
    std::vector<double> others = angles;
    for (int k = 0; k < 300; ++k) others.push_back(upper * k / 300);
    for (const double step : {1e-9, 1e-6, 1e-4, 1e-3}) {
      others.push_back(fit.alpha - step);
      others.push_back(fit.alpha + step);
    }
    for (const double alpha : others) {
      if (alpha < 0 || alpha > 0.99 * upper) continue;  // on short intervals the powers are ill-conditioned
      const Oracle oracle(angles, alpha);
      const double error = static_cast<double>(oracle.error(oracle.best()));
      ASSERT_GE(error, fit.error * (1 - 1e-9))
          << "α " << alpha << " beats " << fit.alpha << ", " << angles.size() << " angles";
    }
  }
}

TEST(CdfFit, FindsTheCubicFromWhichAnglesAreDrawn) {
  constexpr double alpha = 0.02, a0 = 0.15, a1 = -1.2, a2 = 1.5, a3 = -0.9;
  const auto cdf = [&](double theta) {
    const double x = theta - alpha;
    return x < 0 ? 0 : a0 - a1 * x - a2 * x * x - a3 * x * x * x;
  };
  for (const int n : {100, 1000, 10000, 100000}) {
    std::vector<double> angles;
    for (int k = 0; k < n; ++k) {
      const double height = (k + 0.5) / n;
      double low = alpha, high = 2;
      for (int i = 0; i < 100; ++i) (cdf((low + high) / 2) < height ? low : high) = (low + high) / 2;
      angles.push_back(high);
    }
    const CdfFit fit = fit_cdf(angles, upper);
    ASSERT_EQ(fit.verdict, FitVerdict::fitted);
    // The CDF of n angles is within half a step of the cubic. The error of a_n scales with its n-th derivative over the
    // window.
    const double step = 0.5 / n;
    EXPECT_NEAR(fit.alpha, alpha, std::numeric_limits<double>::epsilon());
    EXPECT_NEAR(fit.a[0], a0, step) << n;
    EXPECT_NEAR(fit.a[1], a1, 30 * step / upper) << n;
    EXPECT_NEAR(fit.a[2], a2, 150 * step / (upper * upper)) << n;
    EXPECT_NEAR(fit.a[3], a3, 300 * step / (upper * upper * upper)) << n;
    EXPECT_NEAR(fit.error, 0, upper * step * step) << n;
  }
}

TEST(CdfFit, FractionAtUltraLowAnglesIsRecovered) {
  constexpr int seeds = 100;
  for (const double f : {0.05, 0.1, 0.3}) {
    for (const int n : {450, 2000}) {
      double bias = 0, normalised = 0;
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        RandomStream random{17, seed};
        const std::vector<double> angles = mixture(n, f, 1, random);
        const CdfFit fit = fit_cdf(angles, upper);
        ASSERT_EQ(fit.verdict, FitVerdict::fitted)
            << "f " << f << ", n " << n << ", seed " << seed << ", a_0 " << fit.a[0];
        const double truth = std::round(f * n) / n;
        EXPECT_NEAR(fit.a[0], truth, 5 * fit.a0_error) << "f " << f << ", n " << n << ", seed " << seed;
        bias += (fit.a[0] - truth) / fit.a0_error / seeds;
        normalised += std::pow((fit.a[0] - truth) / fit.a0_error, 2) / seeds;
        const auto below = std::count_if(angles.begin(), angles.end(), [&](double x) { return x < fit.cutoff; });
        EXPECT_NEAR(static_cast<double>(below), fit.a[0] * n, 0.5 + 1e-9 * n);
        EXPECT_LE(fit.alpha, 1e-2) << "the jump is at ultra-low angles";
      }
      EXPECT_LT(std::abs(bias), 5 / std::sqrt(seeds)) << "f " << f << ", n " << n;
      EXPECT_NEAR(std::sqrt(normalised), 1, 0.35) << "a0_error is the scatter of a_0; f " << f << ", n " << n;
    }
  }
}

TEST(CdfFit, JumpOfOneAngleCollapses) {
  const auto with_jump = [](int size) {
    std::vector<double> angles(size, 0.0);
    for (int k = 0; k < 2000; ++k) angles.push_back((k + 0.5) / 2000);
    return fit_cdf(angles, upper).verdict;
  };
  EXPECT_EQ(with_jump(1), FitVerdict::collapsed);
  EXPECT_EQ(with_jump(200), FitVerdict::fitted);
}

TEST(CdfFit, TwoJumpsAreBimodal) {
  RandomStream random{23};
  for (const double second : {0.0, 0.05, 0.2, 0.4}) {
    int bimodal = 0;
    for (int trial = 0; trial < 100; ++trial) {
      std::vector<double> angles = mixture(400, 0.2, 1, random);
      for (int k = 0; k < second * 400; ++k) angles.push_back(upper * (0.5 + 0.01 * random.uniform()));
      const CdfFit fit = fit_cdf(angles, upper);
      bimodal += fit.verdict == FitVerdict::bimodal;
      EXPECT_GT(fit.cutoff, 0) << "second jump of " << second << ", trial " << trial;
      EXPECT_EQ(fit.verdict == FitVerdict::bimodal, fit.deviation * std::sqrt(angles.size()) > 1.358);
    }
    EXPECT_LE(bimodal, second < 0.1 ? 5 : 100) << "second jump of " << second;
    EXPECT_GE(bimodal, second < 0.1 ? 0 : 100) << "second jump of " << second;
  }
}

TEST(CdfFit, AJumpFarFromAlignmentIsOutOfRange) {
  for (const double at : {0.1, 0.45, 0.55, 0.8}) {
    std::vector<double> angles(60, at * upper);
    for (int k = 0; k < 340; ++k) angles.push_back(upper * (1 + (k + 0.5) / 100));
    const CdfFit fit = fit_cdf(angles, upper);
    EXPECT_EQ(fit.verdict, at < 0.5 ? FitVerdict::fitted : FitVerdict::alpha_out_of_range) << at;
    EXPECT_EQ(fit.cutoff > 0, at < 0.5) << at;
  }
}

TEST(CdfFit, FewAnglesInTheWindowAreTooFew) {
  std::vector<double> angles(100, 1.0);
  EXPECT_EQ(fit_cdf({}, upper).verdict, FitVerdict::too_few);
  for (int k = 0; k < 5; ++k) {
    const CdfFit fit = fit_cdf(angles, upper);
    EXPECT_EQ(fit.verdict, FitVerdict::too_few) << k << " angles in the window";
    EXPECT_EQ(fit.cutoff, 0);
    angles[k] = 0.01 * (k + 1);
  }
  EXPECT_NE(fit_cdf(angles, upper).verdict, FitVerdict::too_few);
  EXPECT_EQ(CdfFit{}.verdict, FitVerdict::not_called);
}

TEST(CdfFit, OrderUnitAndRepetitionDoNotMatter) {
  RandomStream random{20};
  for (const std::vector<double>& angles : families(random)) {
    const CdfFit fit = fit_cdf(angles, upper);
    std::vector<double> shuffled = angles;
    for (std::size_t k = shuffled.size(); k > 1; --k) std::swap(shuffled[k - 1], shuffled[random.bits() % k]);
    const CdfFit same = fit_cdf(shuffled, upper);
    for (double& angle : shuffled) angle *= 4;  // multiplying by a power of two does not change any rounding
    const CdfFit scaled = fit_cdf(shuffled, 4 * upper);
    EXPECT_EQ(fit.verdict, same.verdict);
    EXPECT_EQ(fit.verdict, scaled.verdict);
    EXPECT_EQ(fit.alpha, same.alpha);
    EXPECT_EQ(4 * fit.alpha, scaled.alpha);
    EXPECT_EQ(4 * fit.cutoff, scaled.cutoff);
    EXPECT_EQ(4 * fit.error, scaled.error);
    for (int n = 0; n < 4; ++n) {
      EXPECT_EQ(fit.a[n], same.a[n]);
      EXPECT_EQ(fit.a[n], std::pow(4, n) * scaled.a[n]);
    }
    std::vector<double> twice = angles;
    twice.insert(twice.end(), angles.begin(), angles.end());
    if (fit.verdict == FitVerdict::too_few) continue;
    EXPECT_NEAR(fit_cdf(twice, upper).a[0], fit.a[0], 1e-9);
  }
}

TEST(CdfFit, RejectsInvalidAngles) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -1e-9}) {
    const std::vector<double> angles{0.1, bad, 0.2};
    EXPECT_THROW(fit_cdf(angles, upper), std::invalid_argument) << bad;
  }
  for (const double bad : {nan, infinity, 0.0, -1.0}) {
    EXPECT_THROW(fit_cdf(std::vector<double>{0.1}, bad), std::invalid_argument) << bad;
  }
}

}  // namespace
}  // namespace isojam
