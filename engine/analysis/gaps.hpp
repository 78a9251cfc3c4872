#pragma once

#include <vector>

#include "engine/packing/neighbours.hpp"

namespace isojam {

/// A pair of particles that nearly touch.
struct Gap {
  NeighbourPair pair;  ///< the particles, and the image of b
  /// The largest distance (V_p^(1/3)) between two parallel planes that separate the particles. Planes are perpendicular
  /// to the normal of a face, or to the vector product of two edges. The width is the distance of the particles, or
  /// less if the nearest points are vertices.
  double width = 0;
  /// true if the planes are parallel to a face; false if they are parallel to an edge of each particle
  bool of_faces = true;
};

/// Finds all pairs that do not touch and have a gap below `widest` (V_p^(1/3)), sorted by (a, b, shift). It uses only
/// the first double of each coordinate, so the error is about 1e-16. Throws std::invalid_argument unless 0 < widest.
std::vector<Gap> near_gaps(const Packing& packing, double widest);

}  // namespace isojam
