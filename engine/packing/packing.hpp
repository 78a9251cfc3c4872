#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/packing/periodic_cell.hpp"
#include "engine/random/stream.hpp"

namespace isojam {

/// N equal solids in a periodic cube: a value. Positions are not wrapped into the cell.
struct Packing {
  const ConvexSolid* solid;  ///< never null, immutable, outlives the packing
  PeriodicCell cell;
  std::vector<Pose> poses;

  int size() const { return static_cast<int>(poses.size()); }
  double density() const { return size() / cell.volume(); }
};

/// Random packing of n particles at density φ: positions uniform in the cell, orientations uniform on SO(3). Numbered
/// along a curve through the cell, so that neighbours have near numbers.
/// Throws std::invalid_argument if n < 1, φ is not in (0, 1], or the cell is not larger than least_side(solid).
Packing random_packing(const ConvexSolid& solid, int n, double density, RandomStream& random);

/// The packing at another density: isotropic strain moves centres affinely and leaves orientations alone.
Packing strained_to(const Packing& packing, double density);

/// Moves every particle whose entries are not all zero: step has 6N, per particle (dx, R·dθ), lab frame, R the radius
/// of gyration.
Packing moved(const Packing& packing, const Eigen::VectorXd& step);

}  // namespace isojam
