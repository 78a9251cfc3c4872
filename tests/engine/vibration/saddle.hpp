#pragma once

#include <Eigen/Geometry>

#include "tests/engine/solve/solve_support.hpp"

namespace isojam {

/// A packing of side³ particles on a cubic lattice. All have the same random orientation.
inline Packing lattice(SolidKind kind, int side, double density, std::uint64_t seed) {
  RandomStream random{seed};
  Eigen::Quaterniond orientation(random.normal(), random.normal(), random.normal(), random.normal());
  orientation.normalize();
  const int n = side * side * side;
  Packing packing{platonic(kind), PeriodicCell(side_at(n, density)), {}};
  const double spacing = packing.cell.side() / side;
  for (int k = 0; k < n; ++k) {
    Pose pose;
    const int x = k / (side * side), y = k / side % side, z = k % side;
    pose.position = spacing * Eigen::Vector3d(x, y, z);
    pose.orientation = orientation;
    packing.poses.push_back(pose);
  }
  return packing;
}

}  // namespace isojam
