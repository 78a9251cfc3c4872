#pragma once

#include <algorithm>

#include "engine/geometry/overlap/distances.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// The lesser fine_below() of the two, in the size of the larger one, whose coordinates are rounded most.
inline double fine_below(const ConvexSolid& a, const ConvexSolid& b) {
  return std::max(a.scale(), b.scale()) * std::min(a.fine_below(), b.fine_below());
}

/// Distance below which a double-double overlap takes distances in double-double too: 2e-3 of fine_below().
/// The rounding of larger ones, gap_tolerance(), is below 1e-11 of themselves.
inline double double_double_below(const ConvexSolid& a, const ConvexSolid& b) { return 2e-3 * fine_below(a, b); }

/// Distance of a vertex from a face plane of the other solid, n·(y − to_other) − offset, negative inside, to 1e-31.
/// Both solids are placed in double-double.
DoubleDouble distance_double_double(const PlacedSolid& body, int vertex, const PlacedSolid& other, int plane,
                                    const DoubleDoubleVector& to_other);

/// Takes the small distances of a table, as tabulate_distances() left it, again in double-double: each is right to its
/// last bits however small it is. Both solids are placed in double-double.
void correct_small_distances(const PlacedSolid& body, const PlacedSolid& other, const DoubleDoubleVector& to_other,
                             Distances& d);

}  // namespace isojam
