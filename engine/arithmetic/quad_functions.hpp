#pragma once

#include "engine/arithmetic/elementary.hpp"

// The functions for Quad are those of the C library for long double or those of libquadmath. They are declared here
// because <quadmath.h> is among g++'s own headers, which clang does not find.
#if LDBL_MANT_DIG == 113
#define QUAD(function) function##l
#else
#define QUAD(function) function##q
#endif

namespace isojam {

extern "C" {
Quad QUAD(sqrt)(Quad) noexcept, QUAD(cbrt)(Quad) noexcept, QUAD(hypot)(Quad, Quad) noexcept;
Quad QUAD(sin)(Quad) noexcept, QUAD(cos)(Quad) noexcept, QUAD(tan)(Quad) noexcept;
Quad QUAD(asin)(Quad) noexcept, QUAD(acos)(Quad) noexcept, QUAD(atan)(Quad) noexcept, QUAD(atan2)(Quad, Quad) noexcept;
Quad QUAD(exp)(Quad) noexcept, QUAD(log)(Quad) noexcept, QUAD(log1p)(Quad) noexcept, QUAD(log10)(Quad) noexcept;
Quad QUAD(pow)(Quad, Quad) noexcept, QUAD(erfc)(Quad) noexcept, QUAD(lgamma)(Quad) noexcept;
}

}  // namespace isojam
