#pragma once

#include <cfloat>

// The C library has two versions of each elementary function, with and without fused multiply-adds, and selects one for
// the processor at run time. Because their last bits differ, results with the C library depend on the processor.

/// Elementary functions with the same bits on every processor, because they are computed in software in quadruple
/// precision, and rounded once to the nearest double. For infinities and NaN, the results are those of the standard
/// library. Each call takes about a microsecond, which is too slow for innermost loops.
namespace isojam::nearest {

/// The functions of the standard library with the same names. @{
double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan2(double y, double x);
double exp(double x);
double log(double x);
double log1p(double x);
double log10(double x);
double pow(double x, double y);
double cbrt(double x);
double hypot(double x, double y);
/// @}

}  // namespace isojam::nearest

namespace isojam {

/// Quadruple precision (113 bits), computed in software.
#if LDBL_MANT_DIG == 113
using Quad = long double;
#else
__extension__ using Quad = __float128;
#endif

/// The function sin x / x, which is 1 at x = 0, with a relative error of at most 2 ε, where ε = 2⁻⁵². For |x| ≤ 1 it
/// uses the power series and takes only nanoseconds, so it can be used for rotations in innermost loops.
double sinc(double x);

/// The Legendre polynomial P_l(x), for |x| ≤ 1. (libc++ has no std::legendre.)
double legendre(unsigned l, double x);

inline double squared(double x) { return x * x; }    ///< x²
inline double cubed(double x) { return x * x * x; }  ///< x³

}  // namespace isojam
