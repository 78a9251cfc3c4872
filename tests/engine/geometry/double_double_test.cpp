// Reference: quadruple precision.

#include "engine/geometry/double_double.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/quad.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

constexpr int cases = 20000;
constexpr double u = 1.1102230246251565e-16;

double random_double(RandomStream& random, double decades) {
  return random.normal() * std::pow(10, decades * (2 * random.uniform() - 1));
}

DoubleDouble random_number(RandomStream& random, double decades) {
  const double high = random_double(random, decades);
  return two_sum(high, high * u * (2 * random.uniform() - 1));
}

double relative_error(Quad value, Quad exact) {
  const Quad error = value > exact ? value - exact : exact - value;
  return static_cast<double>(error / (exact < 0 ? -exact : exact));
}

/// Relative error of a result; infinite if its high part is not the nearest double.
double error_of(const DoubleDouble& value, Quad exact) {
  if (value.high != value.high + value.low) return INFINITY;
  return exact == 0 && value.high == 0 ? 0 : relative_error(widened(value), exact);
}

TEST(DoubleDoubleTest, SumAndProductOfDoublesLoseNothing) {
  RandomStream random{61, 1};
  for (int k = 0; k < cases; ++k) {
    // Quadruple precision contains the sum exactly while the terms are within 60 bits of each other.
    const double a = random_double(random, 8), b = random_double(random, 8);
    const DoubleDouble sum = two_sum(a, b), product = two_product(a, b);
    EXPECT_TRUE(widened(sum) == Quad(a) + Quad(b)) << a << " + " << b;
    EXPECT_TRUE(widened(product) == Quad(a) * Quad(b)) << a << " · " << b;
    EXPECT_EQ(sum.high, a + b);
    const DoubleDouble fast = std::abs(a) >= std::abs(b) ? fast_two_sum(a, b) : fast_two_sum(b, a);
    EXPECT_EQ(fast.high, sum.high);
    EXPECT_EQ(fast.low, sum.low);
  }
}

TEST(DoubleDoubleTest, OperationsKeepTheirErrors) {
  RandomStream random{61, 2};
  double sum = 0, short_one = 0, product = 0, quotient = 0, root = 0;
  for (int k = 0; k < cases; ++k) {
    const DoubleDouble a = random_number(random, 30), b = random_number(random, k % 2 ? 30 : 1);
    const Quad x = widened(a), y = widened(b);
    sum = std::fmax(sum, std::fmax(error_of(a + b, x + y), error_of(a - b, x - y)));
    const Quad terms = (x < 0 ? -x : x) + (y < 0 ? -y : y);
    const Quad error = widened(short_sum(a, b)) - (x + y);
    short_one = std::fmax(short_one, std::abs(static_cast<double>(error / terms)));
    product = std::fmax(product, error_of(a * b, x * y));
    quotient = std::fmax(quotient, error_of(a / b, x / y));
    const DoubleDouble positive = a.high < 0 ? -a : a;
    root = std::fmax(root, error_of(reciprocal_sqrt(positive), 1 / square_root(widened(positive))));
  }
  EXPECT_LE(sum, 4 * u * u);
  EXPECT_LE(short_one, 4 * u * u);
  EXPECT_LE(product, 8 * u * u);
  EXPECT_LE(quotient, 16 * u * u);
  EXPECT_LE(root, 16 * u * u);
}

TEST(DoubleDoubleTest, NearlyOppositeNumbersKeepTheDigitsOfTheirSum) {
  RandomStream random{61, 3};
  for (int k = 0; k < cases; ++k) {
    const DoubleDouble a = random_number(random, 3);
    DoubleDouble b = -a;
    b.low *= 1 + random_double(random, 3) * u;
    b = two_sum(b.high, b.low);
    // The high parts cancel. Quadruple precision contains the rest exactly, but not always a and b themselves.
    const Quad exact = (Quad(a.high) + Quad(b.high)) + (Quad(a.low) + Quad(b.low));
    EXPECT_LE(error_of(a + b, exact), 4 * u * u) << a.high << " + " << a.low;
  }
}

TEST(QuadTest, RootsAndNarrowing) {
  RandomStream random{61, 4};
  for (int k = 0; k < cases; ++k) {
    const Quad x = widened(random_number(random, 30)), positive = x < 0 ? -x : x;
    const Quad square = square_root(positive), cube = cube_root(x);
    EXPECT_LE(relative_error(square * square, positive), 1e-33);
    EXPECT_LE(relative_error(cube * cube * cube, x), 2e-33);
    EXPECT_LE(error_of(narrowed(x), x), u * u);
    const Quad third = x / 3;
    EXPECT_LE(error_of(narrowed(third), third), u * u);
  }
  EXPECT_TRUE(square_root(0) == 0);
  EXPECT_TRUE(cube_root(0) == 0);
}

}  // namespace
}  // namespace isojam
