#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/random/stream.hpp"

namespace isojam::testing_pairs {

inline constexpr double epsilon = 2.220446049250313e-16;  ///< of double

/// Two Platonic solids in the lab frame.
struct Pair {
  SolidKind kind_a, kind_b;
  Pose a, b;

  const ConvexSolid& solid_a() const { return platonic(kind_a); }
  const ConvexSolid& solid_b() const { return platonic(kind_b); }
  Eigen::Vector3d displacement() const { return b.position - a.position; }
  RelativePose relative() const { return relative_pose(a.orientation, b.orientation, displacement()); }
  /// Largest distance that a coordinate of the pair can have from a centre.
  double reach() const { return displacement().norm() + solid_a().circumradius() + solid_b().circumradius(); }
};

Eigen::Vector3d random_direction(RandomStream& random);
Eigen::Quaterniond random_orientation(RandomStream& random);

/// Random orientations, A at distance 1 from the origin, B in a random direction at `distance`.
Pair random_pair(RandomStream& random, SolidKind a, SolidKind b, double distance);

/// The same with V between the given bounds.
Pair random_contact(RandomStream& random, SolidKind a, SolidKind b, double least_volume, double greatest_volume);

Overlap overlap(const Pair& pair);

/// The pair with A and B exchanged.
Pair exchanged(const Pair& pair);

/// B's moment about its own centre in A's frame: M_B = −M_A + r×S_A.
Eigen::Vector3d moment_of_b(const Overlap& overlap, const RelativePose& pose);

/// All digits of the input, so that a failure can be reproduced.
std::string describe(const Pair& pair);

}  // namespace isojam::testing_pairs
