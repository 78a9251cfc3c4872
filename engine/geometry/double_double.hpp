#pragma once

#include <cmath>

namespace isojam {

/// A double-double: the unevaluated sum high + low of two doubles, high = fl(high + low), about 106 bits (Dekker 1971,
/// Knuth). Notation: fl rounds to double, u = 2⁻⁵³. Relative errors without over- or underflow: sum and difference
/// 4 u², product 8 u², quotient and reciprocal root 16 u². These bounds require that every operation is rounded exactly
/// once: no -ffast-math, no contraction.
struct DoubleDouble {
  double high = 0, low = 0;  ///< leading part, and the rounding error

  DoubleDouble() = default;
  /// The double itself, exactly.
  // NOLINTNEXTLINE(google-explicit-constructor): every double is exactly a double-double, and formulae mix them.
  DoubleDouble(double value) : high(value) {}
  /// The sum head + tail; the parts must satisfy head = fl(head + tail).
  DoubleDouble(double head, double tail) : high(head), low(tail) {}
};

/// Error-free sum a + b, if |a| ≥ |b| or a = 0.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Error-free sum a + b (Knuth).
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// Error-free product a·b, unless it underflows.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }  ///< −a, exactly

/// a + b.
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
  const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
  return fast_two_sum(sum.high, sum.low + low.low);
}

/// Sum a + b at half the cost, with an error of at most 4 u² (|a| + |b|).
inline DoubleDouble short_sum(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.high, b.high);
  return fast_two_sum(high.high, high.low + (a.low + b.low));
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }  ///< a − b

/// a·b.
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = two_product(a.high, b.high);
  return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// a/b.
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * first;
  const double second = rest.high / b.high;
  const DoubleDouble rest_of_rest = rest - b * second;
  return fast_two_sum(first, second) + rest_of_rest.high / b.high;
}

/// Reciprocal root 1/√a for a > 0.
inline DoubleDouble reciprocal_sqrt(const DoubleDouble& a) {
  const double guess = 1 / std::sqrt(a.high);
  // One step of Newton's method doubles the number of correct digits.
  const DoubleDouble rest = 1.0 - a * two_product(guess, guess);
  return fast_two_sum(guess, guess * rest.high / 2);
}

}  // namespace isojam
