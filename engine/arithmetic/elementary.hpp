#pragma once

// The C library has two versions of each elementary function, one of them for processors with fused multiply-adds, and
// chooses at run time. Their last bits differ, and so would the results of a replicate.

/// Elementary functions with the same bits on every processor: computed in software quadruple precision and rounded
/// once to the nearest double. Infinities and NaN give the same as with the standard library. Each call takes about a
/// microsecond, so do not use them in innermost loops.
namespace isojam::nearest {

/// The functions of the standard library with these names.
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

/// sin x / x, and 1 at x = 0; relative error at most 2 ε. For |x| ≤ 1 it uses the series and takes nanoseconds, so that
/// it can be used for rotations in innermost loops.
double sinc(double x);

inline double squared(double x) { return x * x; }    ///< x²
inline double cubed(double x) { return x * x * x; }  ///< x³

}  // namespace isojam
