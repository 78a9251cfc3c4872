#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/random/stream.hpp"

namespace isojam::testing_pairs {

inline constexpr double epsilon = 2.220446049250313e-16;  ///< distance from 1 to the next larger double

/// Two named solids in the lab frame.
struct Pair {
  SolidKind kind_a, kind_b;
  Pose a, b;

  const ConvexSolid& solid_a() const { return platonic(kind_a); }
  const ConvexSolid& solid_b() const { return platonic(kind_b); }
  Eigen::Vector3d displacement() const { return b.position - a.position; }
  RelativePose relative() const { return relative_pose(a.orientation, b.orientation, displacement()); }
};

Eigen::Vector3d random_direction(RandomStream& random);
Eigen::Quaterniond random_orientation(RandomStream& random);

/// A pair with random orientations. The centre of A has the distance 1 from the origin. B is displaced from A in a
/// random direction by `distance`.
Pair random_pair(RandomStream& random, SolidKind a, SolidKind b, double distance);

/// A pair with random orientations whose V is between these bounds.
Pair random_contact(RandomStream& random, SolidKind a, SolidKind b, double least_volume, double greatest_volume);

Overlap overlap(const Pair& pair);

/// Text with all digits of the pair, so that a failure can be reproduced.
std::string describe(const Pair& pair);

}  // namespace isojam::testing_pairs
