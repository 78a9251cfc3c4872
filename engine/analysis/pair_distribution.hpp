#pragma once

#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam {

/// Pair distribution function g(r) of the centres: the number of centres at a distance r from a centre, divided by the
/// number in an ideal gas of the same density. Bin k covers k·width ≤ r < (k + 1)·width (V_p^(1/3)). The last bin ends
/// at most at `farthest`, and at most at half of the shortest lattice translation. The reason for the second limit: at
/// smaller distances, there is at most one image of each other particle. Only the first double of each coordinate is
/// used. Throws std::invalid_argument unless 0 < width.
std::vector<double> pair_distribution(const Packing& packing, double width, double farthest);

}  // namespace isojam
