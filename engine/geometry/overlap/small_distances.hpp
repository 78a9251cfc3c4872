#pragma once

#include <algorithm>

#include "engine/geometry/overlap/distances.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// The smaller fine_below() of the two solids, multiplied by the larger scale of the two, because the coordinates of
/// the larger solid have the larger rounding errors.
inline double fine_below(const ConvexSolid& a, const ConvexSolid& b) {
  return std::max(a.scale(), b.scale()) * std::min(a.fine_below(), b.fine_below());
}

/// Limit of small distances, 2e-3 times fine_below(): if r is in double-double, overlap() computes distances below this
/// limit in double-double. The rounding error gap_tolerance() of larger distances is below 1e-11 of the distance.
inline double double_double_below(const ConvexSolid& a, const ConvexSolid& b) { return 2e-3 * fine_below(a, b); }

/// Distance n·(y − to_other) − offset of a vertex y of `body` from a face plane of `other`. It is negative inside, and
/// its error is at most 1e-31. Both solids must have been placed in double-double.
DoubleDouble distance_double_double(const PlacedSolid& body, int vertex, const PlacedSolid& other, int plane,
                                    const DoubleDoubleVector& to_other);

/// Recomputes the small distances in a table of tabulate_distances() in double-double, so that even the smallest ones
/// are correct to their last bits. Both solids must have been placed in double-double.
template <class Solids>
void correct_small_distances(const PlacedSolid& body, const PlacedSolid& other, const DoubleDoubleVector& to_other,
                             Distances<Solids>& d);

}  // namespace isojam
