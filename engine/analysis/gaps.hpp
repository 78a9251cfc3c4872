#pragma once

#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/packing/neighbours.hpp"

namespace isojam {

/// A pair of particles that nearly touch.
struct Gap {
  NeighbourPair pair;  ///< the particles, and the image of b
  /// Width of the gap, in units of V_p^(1/3): the distance of two parallel planes that separate the particles. Two
  /// types of planes are considered: parallel to a face of a or b, and parallel to an edge of a and an edge of b. The
  /// largest distance of all such planes is the width. It is at most the distance between the particles. It can be
  /// smaller, for example if two vertices are the nearest points.
  double width = 0;
  /// true if two separating planes that are parallel to a face have the distance `width`, within rounding errors
  bool of_faces = false;
  RelativePose pose{};                              ///< pose of b in the body frame of a
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< normal of these planes, from a to b, in the body frame of a
};

/// Finds all pairs that do not touch and whose gap has a width below `max_width` (V_p^(1/3)), sorted by (a, b, shift).
/// Coordinates are rounded to double, so the width has an error of a few 1e-15. Throws std::invalid_argument unless 0 <
/// max_width.
std::vector<Gap> near_gaps(const Packing& packing, double max_width);

/// The pair as a contact, so that its angles can be computed: b has moved towards a by `reach` along the axis of the
/// gap. The intersection is empty if another axis then still separates the particles, as for two nearby vertices.
Contact as_contact(const Packing& packing, const Gap& gap, double reach);

}  // namespace isojam
