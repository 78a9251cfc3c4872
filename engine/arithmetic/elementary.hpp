#pragma once

// The C library has two of each elementary function, one for processors with fused multiply-adds, and takes what it
// finds at run time: their last bits differ, and so would results.

/// Elementary functions with the same bits on every processor: reckoned in quadruple precision, in software, and
/// rounded once to the nearest double. Infinities and NaN come out as from the functions of the standard library. A
/// microsecond each: not for the innermost loops.
namespace isojam::nearest {

/// The functions of these names of the standard library.
/// @{
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

/// sin x / x, 1 at 0; right to 2 ε. By its series where |x| ≤ 1, and then in nanoseconds: for turns in innermost loops.
double sinc(double x);

inline double squared(double x) { return x * x; }    ///< x²
inline double cubed(double x) { return x * x * x; }  ///< x³

}  // namespace isojam
