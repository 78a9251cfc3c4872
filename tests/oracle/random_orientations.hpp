#pragma once

#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/random/stream.hpp"

// Reference values for tests of RandomAlignment. They are sampled from the faces, edges and vertices of a convex solid.

namespace isojam::oracle {

/// The alignment angles of one contact.
struct AlignmentAngles {
  double face_face = 0, edge_face = 0;  ///< θ_ff and θ_ef
};

/// Angles of n contacts in which a vertex touches a face. Orientations are random.
std::vector<AlignmentAngles> sample_unconstrained(const ConvexSolid& solid, int n, RandomStream& random);
/// Angles of n contacts in which a random edge lies in a face. Rotations about the edge are random.
std::vector<AlignmentAngles> sample_edge_constrained(const ConvexSolid& solid, int n, RandomStream& random);

}  // namespace isojam::oracle
