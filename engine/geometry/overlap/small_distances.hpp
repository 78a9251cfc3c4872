#pragma once

#include <algorithm>

#include "engine/geometry/overlap/distances.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// The smaller fine_below() of the two solids, scaled by the larger solid, whose coordinates have the largest rounding
/// error.
inline double fine_below(const ConvexSolid& a, const ConvexSolid& b) {
  return std::max(a.scale(), b.scale()) * std::min(a.fine_below(), b.fine_below());
}

/// Distance below which an overlap in double-double also computes distances in double-double: 2e-3 of fine_below(). The
/// relative rounding error of larger distances, gap_tolerance(), is below 1e-11.
inline double double_double_below(const ConvexSolid& a, const ConvexSolid& b) { return 2e-3 * fine_below(a, b); }

/// Distance of a vertex from a face plane of the other solid, n·(y − to_other) − offset, negative inside, with an error
/// of at most 1e-31. Both solids must be placed in double-double.
DoubleDouble distance_double_double(const PlacedSolid& body, int vertex, const PlacedSolid& other, int plane,
                                    const DoubleDoubleVector& to_other);

/// Recomputes the small distances of a table from tabulate_distances() in double-double, so that each is correct to its
/// last bits however small it is. Both solids must be placed in double-double.
void correct_small_distances(const PlacedSolid& body, const PlacedSolid& other, const DoubleDoubleVector& to_other,
                             Distances& d);

}  // namespace isojam
