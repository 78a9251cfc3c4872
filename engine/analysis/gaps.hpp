#pragma once

#include <vector>

#include "engine/packing/neighbours.hpp"

namespace isojam {

/// A pair of particles that nearly touch.
struct Gap {
  NeighbourPair pair;  ///< the particles, and the image of b
  /// The largest distance between two parallel planes that separate the particles, over all normals of faces and all
  /// products of edges, V_p^(1/3). It is the distance of the particles, or smaller if they are nearest at vertices.
  double width = 0;
  bool of_faces = true;  ///< true if the planes are parallel to a face; else they are parallel to an edge of each
};

/// All pairs that do not touch and have a gap below `widest` (V_p^(1/3)), sorted by (a, b, shift). Uses only the high
/// parts of the state, so that the error is about 1e-16. Throws std::invalid_argument unless 0 < widest.
std::vector<Gap> near_gaps(const Packing& packing, double widest);

}  // namespace isojam
