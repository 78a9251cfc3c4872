#pragma once

#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/random/stream.hpp"

// Test oracle of RandomAlignment, from the features of any convex solid.

namespace isojam::oracle {

/// The angles of one contact.
struct AlignmentAngles {
  double face_face = 0, edge_face = 0;  ///< θ_ff and θ_ef
};

/// Angles for n random orientations in which a vertex touches.
std::vector<AlignmentAngles> sample_unconstrained(const ConvexSolid& solid, int n, RandomStream& random);
/// Angles for n rotations about a random edge that lies in the face.
std::vector<AlignmentAngles> sample_edge_constrained(const ConvexSolid& solid, int n, RandomStream& random);

}  // namespace isojam::oracle
