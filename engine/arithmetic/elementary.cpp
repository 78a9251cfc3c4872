#include "engine/arithmetic/elementary.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/arithmetic/quad_functions.hpp"

namespace isojam {
namespace nearest {

double sin(double x) { return static_cast<double>(QUAD(sin)(x)); }
double cos(double x) { return static_cast<double>(QUAD(cos)(x)); }
double tan(double x) { return static_cast<double>(QUAD(tan)(x)); }
double asin(double x) { return static_cast<double>(QUAD(asin)(x)); }
double acos(double x) { return static_cast<double>(QUAD(acos)(x)); }
double atan2(double y, double x) { return static_cast<double>(QUAD(atan2)(y, x)); }
double exp(double x) { return static_cast<double>(QUAD(exp)(x)); }
double log(double x) { return static_cast<double>(QUAD(log)(x)); }
double log1p(double x) { return static_cast<double>(QUAD(log1p)(x)); }
double log10(double x) { return static_cast<double>(QUAD(log10)(x)); }
double pow(double x, double y) { return static_cast<double>(QUAD(pow)(x, y)); }
double cbrt(double x) { return static_cast<double>(QUAD(cbrt)(x)); }
double hypot(double x, double y) { return static_cast<double>(QUAD(hypot)(x, y)); }

}  // namespace nearest

double sinc(double x) {
  // Σ (−x²)^k / (2k+1)!, k ≤ 9: the remainder is below 1/21! = 2e-20.
  constexpr std::array factors{6.0, 20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0, 342.0};  // 2k (2k+1)
  if (!(std::abs(x) <= 1)) return nearest::sin(x) / x;
  const double square = x * x;
  double sum = 1;
  for (std::size_t k = factors.size(); k-- > 0;) sum = 1 - square / factors[k] * sum;
  return sum;
}

double legendre(unsigned l, double x) {
  double before = 0, value = 1;
  for (unsigned k = 1; k <= l; ++k)  // Arfken, Mathematical Methods for Physicists, eq. 12.17a
    before = std::exchange(value, 2 * x * value - before - (x * value - before) / k);
  return value;
}

}  // namespace isojam
