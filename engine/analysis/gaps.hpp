#pragma once

#include <vector>

#include "engine/packing/neighbours.hpp"

namespace isojam {

/// A pair of particles that nearly touch.
struct Gap {
  NeighbourPair pair;  ///< the particles, and the image of b
  /// Width of the gap (V_p^(1/3)): the largest distance between two parallel planes that separate the particles. Only
  /// planes that are parallel to a face of one particle, or to an edge of each particle, are used. The width is at most
  /// the distance between the particles. It can be smaller, for example if two vertices are the nearest points.
  double width = 0;
  /// true if the planes are parallel to a face
  bool of_faces = true;
};

/// Finds all pairs that do not touch and whose gap is below `widest` (V_p^(1/3)), sorted by (a, b, shift). Only the
/// first double of each coordinate is used, so the error is about 1e-16. Throws std::invalid_argument unless 0 <
/// widest.
std::vector<Gap> near_gaps(const Packing& packing, double widest);

}  // namespace isojam
