#pragma once

#include "engine/geometry/distances.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Distances smaller than this are taken in two doubles in extended precision: 2e-3 of the inradius. The rounding
/// of larger ones, gap_tolerance(), is below 1e-11 of themselves.
double refined_below(const ConvexSolid& a, const ConvexSolid& b);

/// Takes the small distances of a table, as measure() left it, again in two doubles: each is right to its last bits
/// however small it is. Both solids are placed in two doubles.
void refine(const PlacedSolid& body, const PlacedSolid& other, const TwoDoubleVector& to_other, Distances& d);

}  // namespace isojam
