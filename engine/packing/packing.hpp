#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/packing/cell/periodic_cell.hpp"
#include "engine/packing/mixture/composition.hpp"
#include "engine/random/stream.hpp"

namespace isojam {

/// N solids of mean volume V_p = 1 in a periodic cell: a value. Positions are not wrapped into the cell.
struct Packing {
  Composition solids;       ///< the solid of every particle
  PeriodicCell cell;        ///< the periodic cell
  std::vector<Pose> poses;  ///< centre and orientation of every particle

  int size() const { return static_cast<int>(poses.size()); }  ///< N
  double density() const { return size() / cell.volume(); }    ///< φ = N V_p/V_cell
};

/// Random packing of n particles at density φ in a cube: positions uniform in the cell, orientations uniform on SO(3).
/// Particles are numbered along a curve through the cell, so that neighbours have similar numbers. Throws
/// std::invalid_argument if n < 1, φ is not in (0, 1], or the cell is not larger than least_side(solid).
Packing random_packing(const ConvexSolid& solid, int n, double density, RandomStream& random);
/// The same for these particles, whose volumes must have mean 1. Positions do not depend on their order.
Packing random_packing(std::span<const Particle> particles, double density, RandomStream& random);

/// The packing at another density: isotropic strain moves centres affinely and does not change orientations.
Packing strained_to(const Packing& packing, double density);

/// The packing in its cell deformed by F: centres move affinely, orientations do not change. May throw like
/// PeriodicCell::deformed().
Packing deformed(const Packing& packing, const DoubleDoubleMatrix& f);

/// Moves every particle whose entries are not all zero. `step` has 6N entries: per particle (dx, R·dθ), lab frame, R
/// its radius of gyration. Further entries are the free strains ℓ·ε, as many as CellFreedom has: cell and centres are
/// first strained by exp(ε).
Packing moved(const Packing& packing, const Eigen::VectorXd& step);

}  // namespace isojam
