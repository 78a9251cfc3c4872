// Reference: Boost.Math in quadruple precision.

#include "engine/arithmetic/distributions.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace isojam {
namespace {

using Real = boost::multiprecision::cpp_bin_float_quad;

/// Error relative to the reference.
double error(double found, const Real& exact) { return std::abs(static_cast<double>((found - exact) / exact)); }

constexpr double last_bit = 3e-16;

TEST(Distributions, StudentsT) {
  for (const long degrees : {1, 2, 3, 4, 7, 15, 100, 100000}) {
    for (const double share : {.5, .95, .999}) {
      const Real exact = quantile(boost::math::students_t_distribution<Real>(Real(degrees)), (1 + Real(share)) / 2);
      EXPECT_LE(error(student_two_sided(share, degrees), exact), last_bit) << degrees << " degrees, " << share;
    }
  }
}

TEST(Distributions, Normal) {
  for (const double share : {1e-12, 1e-4, .01, .3, .499, .7, .975, 1 - 1e-9}) {
    const Real exact = quantile(boost::math::normal_distribution<Real>(), Real(share));
    EXPECT_LE(error(normal_quantile(share), exact), last_bit) << share;
  }
  EXPECT_EQ(normal_quantile(.5), 0);
  EXPECT_EQ(normal_quantile(.25), -normal_quantile(.75));
}

TEST(Distributions, Binomial) {
  for (const long n : {1, 7, 400, 20000}) {
    for (const double p : {1e-3, .2, .5, .97}) {
      for (const double at : {0., .1, .25, .5, .9, 1.}) {
        const long k = std::lround(at * static_cast<double>(n));
        const auto tails = binomial_tails(n, p, k);
        const boost::math::binomial_distribution<Real> count(static_cast<double>(n), Real(p));
        const Real below = cdf(count, Real(k)), above = k == 0 ? Real(1) : cdf(complement(count, Real(k - 1)));
        if (below > 1e-300) {
          EXPECT_LE(error(tails.at_most, below), 1e-15) << n << ' ' << p << ' ' << k;
        }
        if (above > 1e-300) {
          EXPECT_LE(error(tails.at_least, above), 1e-15) << n << ' ' << p << ' ' << k;
        }
      }
    }
  }
  EXPECT_EQ(binomial_tails(5, 0, 0).at_least, 1);
  EXPECT_EQ(binomial_tails(5, 0, 2).at_least, 0);
  EXPECT_EQ(binomial_tails(5, 1, 5).at_most, 1);
  EXPECT_EQ(binomial_tails(5, 1, 4).at_most, 0);
}

}  // namespace
}  // namespace isojam
