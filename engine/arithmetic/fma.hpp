#pragma once

#include <cmath>

namespace isojam {

#if defined(__x86_64__) && !defined(__FMA__)
/// True if the processor has the fused multiply-add. Without this instruction, the C library computes the same bits,
/// but the program is much slower.
inline bool has_fma() { return __builtin_cpu_supports("fma"); }
/// The sum a·b + c, rounded once.
inline double fma(double a, double b, double c) {
  if (!has_fma()) [[unlikely]]
    return std::fma(a, b, c);
  asm volatile("vfmadd213sd %2, %1, %0" : "+x"(a) : "x"(b), "xm"(c));  // volatile, so that it stays behind the test
  return a;
}
#else
/// True if the processor has the fused multiply-add.
inline bool has_fma() { return true; }
/// The sum a·b + c, rounded once.
inline double fma(double a, double b, double c) { return std::fma(a, b, c); }
#endif

}  // namespace isojam
