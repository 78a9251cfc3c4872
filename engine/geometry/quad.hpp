#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "engine/arithmetic/elementary.hpp"
#include "engine/geometry/double_double.hpp"

namespace isojam {

// The engine uses quadruple precision to construct solids, for pairs with nearly coplanar faces, and for the points
// where contact forces act. Tests use it as the reference.

/// A vector in quadruple precision.
using Quad3 = std::array<Quad, 3>;
using QuadMatrix = std::array<Quad3, 3>;  ///< a matrix in quadruple precision, as three rows

/// The exact value of a double-double: the sum of both doubles.
inline Quad widened(const DoubleDouble& x) { return Quad(x.high) + Quad(x.low); }

/// The double nearest to x, and the double nearest to the remainder.
inline DoubleDouble narrowed(Quad x) {
  const auto high = static_cast<double>(x);
  return {high, static_cast<double>(x - Quad(high))};
}

/// The vector rounded to the nearest doubles.
inline Eigen::Vector3d rounded(const Quad3& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

inline Quad3 operator+(const Quad3& p, const Quad3& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }  ///< p + q
inline Quad3 operator-(const Quad3& p, const Quad3& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }  ///< p − q
inline Quad3 operator*(Quad s, const Quad3& p) { return {s * p[0], s * p[1], s * p[2]}; }                   ///< s p
inline Quad dot(const Quad3& p, const Quad3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }         ///< p·q
/// The vector product p×q.
inline Quad3 cross(const Quad3& p, const Quad3& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
/// The product M p.
inline Quad3 operator*(const QuadMatrix& m, const Quad3& p) { return {dot(m[0], p), dot(m[1], p), dot(m[2], p)}; }
/// The difference M − N.
inline QuadMatrix operator-(const QuadMatrix& m, const QuadMatrix& n) {
  return {m[0] - n[0], m[1] - n[1], m[2] - n[2]};
}
/// The transpose Mᵀ.
inline QuadMatrix transposed(const QuadMatrix& m) {
  return {Quad3{m[0][0], m[1][0], m[2][0]}, Quad3{m[0][1], m[1][1], m[2][1]}, Quad3{m[0][2], m[1][2], m[2][2]}};
}
/// The product M N.
inline QuadMatrix operator*(const QuadMatrix& m, const QuadMatrix& n) {
  const QuadMatrix columns = transposed(n);
  return transposed({m * columns[0], m * columns[1], m * columns[2]});
}

/// Computes √x by two steps of Newton's method from the double nearest to √x. Each step doubles the number of correct
/// digits. Returns 0 if x ≤ 0, and NaN if x is NaN.
inline Quad square_root(Quad x) {
  if (x <= 0) return 0;
  if (x > 0x1p900 && x / 0x1p900 < x) return 0x1p450 * square_root(x / 0x1p900);
  if (x < 0x1p-900) return 0x1p-450 * square_root(0x1p900 * x);
  const double guess = std::sqrt(static_cast<double>(x));
  const Quad root = (guess + x / guess) / 2;
  return (root + x / root) / 2;
}

/// Computes ∛x in the same way.
inline Quad cube_root(Quad x) {
  if (x <= 0) return x < 0 ? -cube_root(-x) : 0;
  if (x > 0x1p900 && x / 0x1p900 < x) return 0x1p300 * cube_root(x / 0x1p900);
  if (x < 0x1p-900) return 0x1p-300 * cube_root(0x1p900 * x);
  Quad root = nearest::cbrt(static_cast<double>(x));
  for (int k = 0; k < 2; ++k) root = root - (root - x / (root * root)) / 3;
  return root;
}

inline Quad norm(const Quad3& p) { return square_root(dot(p, p)); }  ///< |p|

}  // namespace isojam
