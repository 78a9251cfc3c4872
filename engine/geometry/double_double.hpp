#pragma once

#include <cmath>

#include "engine/arithmetic/fma.hpp"

namespace isojam {

/// A double-double: a number that is stored as the sum high + low of two doubles, where `high` is the double nearest to
/// the sum. It has a precision of about 106 bits (Dekker 1971, Knuth). Notation: fl(x) is x rounded to the nearest
/// double, and u = 2⁻⁵³. Largest relative errors without over- or underflow: 4 u² for a sum or difference, 8 u² for a
/// product, 16 u² for a quotient or reciprocal root. These bounds require that every operation is rounded exactly once.
/// Do not compile with -ffast-math or with contraction to fused operations.
struct DoubleDouble {
  double high = 0, low = 0;  ///< nearest double (the high part), and its rounding error (the low part)

  DoubleDouble() = default;
  /// The double-double that is exactly equal to `value`.
  // NOLINTNEXTLINE(google-explicit-constructor): every double is exactly a double-double, and formulae mix them.
  DoubleDouble(double value) : high(value) {}
  /// The sum head + tail. The arguments must satisfy head = fl(head + tail).
  DoubleDouble(double head, double tail) : high(head), low(tail) {}
};

/// The exact sum a + b. Requires |a| ≥ |b| or a = 0.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// The exact sum a + b (Knuth's algorithm).
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// The exact product a·b, unless it underflows.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, fma(a, b, -product)};
}

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }  ///< the exact negative −a

/// The sum a + b.
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
  const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
  return fast_two_sum(sum.high, sum.low + low.low);
}

/// The sum a + b at half the cost of operator+, with an error of at most 4 u² (|a| + |b|).
inline DoubleDouble short_sum(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.high, b.high);
  return fast_two_sum(high.high, high.low + (a.low + b.low));
}

/// the difference a − b
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

/// The product a·b.
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = two_product(a.high, b.high);
  return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// The quotient a/b.
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * first;
  const double second = rest.high / b.high;
  const DoubleDouble rest_of_rest = rest - b * second;
  return fast_two_sum(first, second) + rest_of_rest.high / b.high;
}

/// The reciprocal root 1/√a, for a > 0.
inline DoubleDouble reciprocal_sqrt(const DoubleDouble& a) {
  const double guess = 1 / std::sqrt(a.high);
  // One step of Newton's method doubles the number of correct digits.
  const DoubleDouble rest = 1.0 - a * two_product(guess, guess);
  return fast_two_sum(guess, guess * rest.high / 2);
}

}  // namespace isojam
