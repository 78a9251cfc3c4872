#pragma once

#include <vector>

#include "engine/packing/neighbours.hpp"

namespace isojam {

/// A pair of particles that nearly touch.
struct Gap {
  NeighbourPair pair;  ///< which particles, and the image of b
  /// The largest distance of two parallel planes that keep them apart, over all normals of faces and all products of
  /// edges, V_p^(1/3): their distance, unless vertices are nearest, which are farther apart.
  double width = 0;
  bool of_faces = true;  ///< the planes lie along a face; else along an edge of each
};

/// All pairs that do not touch and have a gap below `widest` (V_p^(1/3)), in order of (a, b, shift), from the high
/// parts of the state: right to some 1e-16. Throws std::invalid_argument unless 0 < widest.
std::vector<Gap> near_gaps(const Packing& packing, double widest);

}  // namespace isojam
