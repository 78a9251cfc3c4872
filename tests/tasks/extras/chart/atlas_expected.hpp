// Expected verdicts of the stability atlas (atlas.hpp) for a method in a regime: for each setting, in the order of the
// atlas, the first letter of an AtlasVerdict. '?' accepts `holds` and `refuses`, depending on rounding.

#pragma once

#include <array>

namespace isojam::test {

struct ExpectedCells {
  const char *regime, *method, *verdicts;
};

inline constexpr auto expected_overlaps = std::to_array<ExpectedCells>({
    // tetrahedron, cube, octahedron, dodecahedron, icosahedron
    {"no difficulty", "contact loop in double-double", "hhhhh"},
    {"no difficulty", "contact loop in doubles", "hhhhh"},
    {"no difficulty", "plain clip in doubles", "hhhhh"},
    // 1e-04, 1e-06, 1e-08, 1e-10, 1e-12, 1e-14
    {"depth, face on face", "contact loop in double-double", "hhhhhh"},
    {"depth, face on face", "contact loop in doubles", "hhhfff"},
    {"depth, face on face", "plain clip in doubles", "hhhfff"},
    {"depth, edge on face", "contact loop in double-double", "hhhhhh"},
    {"depth, edge on face", "contact loop in doubles", "hhhhhh"},
    {"depth, edge on face", "plain clip in doubles", "hhhhhh"},
    {"depth, edge across edge", "contact loop in double-double", "hhhhhh"},
    {"depth, edge across edge", "contact loop in doubles", "hhhhhh"},
    {"depth, edge across edge", "plain clip in doubles", "hhhhhh"},
    {"depth, vertex on face", "contact loop in double-double", "hhhhhh"},
    {"depth, vertex on face", "contact loop in doubles", "hhhhhh"},
    {"depth, vertex on face", "plain clip in doubles", "hhhhhh"},
    {"depth, vertex on vertex", "contact loop in double-double", "hhhhhh"},
    {"depth, vertex on vertex", "contact loop in doubles", "hhhhhh"},
    {"depth, vertex on vertex", "plain clip in doubles", "hhhhhh"},
    // 1e-01, 1e-04, 1e-07, 1e-10, 1e-13, 1e-16, exactly
    {"faces parallel to, 1e-3 deep", "contact loop in double-double", "hhhhhhh"},
    {"faces parallel to, 1e-3 deep", "contact loop in doubles", "hhhhhhh"},
    {"faces parallel to, 1e-3 deep", "plain clip in doubles", "hhhhhhh"},
    {"faces parallel to, 1e-11 deep", "contact loop in double-double", "hhhhhhh"},
    {"faces parallel to, 1e-11 deep", "contact loop in doubles", "hhhffff"},
    {"faces parallel to, 1e-11 deep", "plain clip in doubles", "hhhffff"},
    {"edges parallel to, 1e-3 deep", "contact loop in double-double", "hhhhhhh"},
    {"edges parallel to, 1e-3 deep", "contact loop in doubles", "hhhhhhh"},
    {"edges parallel to, 1e-3 deep", "plain clip in doubles", "hhhhhhh"},
    // 1e-01, 1e-04, 1e-07, 1e-10, 1e-13, 1e-16, 0
    {"same orientation, apart by", "contact loop in double-double", "hhhhhhh"},
    {"same orientation, apart by", "contact loop in doubles", "hhhhhhh"},
    {"same orientation, apart by", "plain clip in doubles", "hhhhhff"},
    // 1e-01, 1e-04, 1e-07, 1e-10, 1e-13, 1e-16
    {"same orientation, faces coplanar, apart by", "contact loop in double-double", "hhhhhh"},
    {"same orientation, faces coplanar, apart by", "contact loop in doubles", "hhhhhh"},
    {"same orientation, faces coplanar, apart by", "plain clip in doubles", "hfhfhf"},
    // tetrahedron, cube, octahedron, dodecahedron, icosahedron
    {"coincident", "contact loop in double-double", "hhhhh"},
    {"coincident", "contact loop in doubles", "hhhhh"},
    {"coincident", "plain clip in doubles", "fffff"},
    // half the size
    {"one inside another", "contact loop in double-double", "r"},
    {"one inside another", "clip in quadruple precision", "h"},
});

inline constexpr auto expected_packings = std::to_array<ExpectedCells>({
    // N = 2, N = 3, N = 4, N = 5, N = 6, N = 7, N = 8
    {"cell just larger than the least", "neighbour list", "hhhhhhh"},
    {"cell of the least side", "neighbour list", "rrrrrrr"},
    {"cell smaller than the least", "neighbour list", "rrrrrrr"},
    {"cell smaller than the least", "nearest images", "fffffff"},
});

inline constexpr auto expected_minimisers = std::to_array<ExpectedCells>({
    // 2e-01, 1e-01, 5e-02, 2e-02, 1e-02, 5e-03, 2e-03, 1e-03, 5e-04
    {"strained to Δφ", "multipliers", "hhhhhhhhh"},
    {"strained to Δφ", "Newton", "hhhhhhhrr"},
    {"strained to Δφ", "conjugate gradients", "?rrrrrrrr"},
    {"strained to Δφ", "conjugate gradients until energy changes by < 1e-12", "frrrrrrrr"},
    {"strained to Δφ", "FIRE", "rrrrrrrrr"},
    {"strained to Δφ", "L-BFGS", "hhrrrrrrr"},
    // residual 1e-9
    {"already jammed start", "Newton", "h"},
    {"already jammed start", "conjugate gradients", "h"},
    {"already jammed start", "conjugate gradients until energy changes by < 1e-12", "h"},
    {"already jammed start", "FIRE", "h"},
    {"already jammed start", "L-BFGS", "h"},
    // beside a vacancy
    {"near-rattlers", "Newton", "h"},
    {"near-rattlers", "conjugate gradients", "r"},
    {"near-rattlers", "conjugate gradients until energy changes by < 1e-12", "r"},
    {"near-rattlers", "FIRE", "r"},
    {"near-rattlers", "L-BFGS", "r"},
    {"near-rattlers", "modes by inertia", "h"},
    // φ = 0.3
    {"unjammed start", "Newton", "h"},
    {"unjammed start", "conjugate gradients", "h"},
    {"unjammed start", "conjugate gradients until energy changes by < 1e-12", "h"},
    {"unjammed start", "FIRE", "h"},
    {"unjammed start", "L-BFGS", "h"},
    // Δφ = 1e-01, Δφ = 5e-03
    {"equilibrium translated through the boundary", "state in double-double", "hh"},
    {"equilibrium translated through the boundary", "state in doubles", "hf"},
    // cube from φ = 0.2, E/N = 3.2e-05, cube from φ = 0.2, E/N = 1.0e-08
    {"cubes", "protocol", "hh"},
    // octahedron from φ = 0.8, E/N = 3.2e-05
    {"already jammed start", "protocol", "h"},
    // octahedron from φ = 0.2, E/N = 3.2e-05
    {"unjammed start", "protocol", "h"},
});

inline constexpr auto expected_modes = std::to_array<ExpectedCells>({
    // 1.5e+03, 2.8e+03, 1.5e+04, 8.4e+04, 1.2e+06, 9.3e+06,
    // 1.5e+08, 6.0e+08, 3.9e+09, 8.9e+10, 1.4e+12, 5.9e+12
    {"softest modes, condition number", "shift-invert, −σ/λ_max = 1e-11", "hhhhhhhhhhhh"},
    {"softest modes, condition number", "shift-invert, −σ/λ_max = 1e-6", "hhhhhhhhhhhh"},
    {"softest modes, condition number", "plain Lanczos", "hh?rrrrrrrrr"},
    // none
    {"Hessian at Δφ = 0.117, step", "analytic", "h"},
    // 1e-03, 1e-04, 1e-05, 1e-06, 1e-07, 1e-08, 1e-09, 1e-10
    {"Hessian at Δφ = 0.117, step", "central differences in doubles", "fhhhhhhh"},
    {"Hessian at Δφ = 0.117, step", "central differences in double-double", "fhhhhhhh"},
    // none
    {"Hessian at Δφ = 0.015, step", "analytic", "h"},
    // 1e-03, 1e-04, 1e-05, 1e-06, 1e-07, 1e-08, 1e-09, 1e-10
    {"Hessian at Δφ = 0.015, step", "central differences in doubles", "fffffhhh"},
    {"Hessian at Δφ = 0.015, step", "central differences in double-double", "fffffhhh"},
});

}  // namespace isojam::test
