#include "engine/arithmetic/elementary.hpp"

#include <array>
#include <cmath>
#include <cstddef>

// The functions are declared here because <quadmath.h> is among g++'s own headers, which clang does not find.
__extension__ using Quad = __float128;
extern "C" {
Quad sinq(Quad) noexcept;
Quad cosq(Quad) noexcept;
Quad tanq(Quad) noexcept;
Quad asinq(Quad) noexcept;
Quad acosq(Quad) noexcept;
Quad atan2q(Quad, Quad) noexcept;
Quad expq(Quad) noexcept;
Quad logq(Quad) noexcept;
Quad log1pq(Quad) noexcept;
Quad log10q(Quad) noexcept;
Quad powq(Quad, Quad) noexcept;
Quad cbrtq(Quad) noexcept;
Quad hypotq(Quad, Quad) noexcept;
}

namespace isojam {
namespace nearest {

double sin(double x) { return static_cast<double>(sinq(x)); }
double cos(double x) { return static_cast<double>(cosq(x)); }
double tan(double x) { return static_cast<double>(tanq(x)); }
double asin(double x) { return static_cast<double>(asinq(x)); }
double acos(double x) { return static_cast<double>(acosq(x)); }
double atan2(double y, double x) { return static_cast<double>(atan2q(y, x)); }
double exp(double x) { return static_cast<double>(expq(x)); }
double log(double x) { return static_cast<double>(logq(x)); }
double log1p(double x) { return static_cast<double>(log1pq(x)); }
double log10(double x) { return static_cast<double>(log10q(x)); }
double pow(double x, double y) { return static_cast<double>(powq(x, y)); }
double cbrt(double x) { return static_cast<double>(cbrtq(x)); }
double hypot(double x, double y) { return static_cast<double>(hypotq(x, y)); }

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

}  // namespace isojam
