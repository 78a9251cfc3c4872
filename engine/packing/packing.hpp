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

/// A packing: N solids of mean volume V_p = 1 in a periodic cell. It is a value type. Positions are not wrapped into
/// the cell.
struct Packing {
  Composition solids;       ///< the solid of every particle
  PeriodicCell cell;        ///< the periodic cell
  std::vector<Pose> poses;  ///< centre and orientation of every particle

  int size() const { return static_cast<int>(poses.size()); }  ///< N
  double density() const { return size() / cell.volume(); }    ///< φ = N V_p/V_cell
};

/// Makes a random packing of n particles at density φ in a cube. Positions are uniform in the cell, and orientations
/// are uniform on SO(3). Particles are numbered along a curve through the cell, so that neighbours have similar
/// numbers. Throws std::invalid_argument if n < 1, φ is not in (0, 1], or the cell is not larger than
/// least_side(solid).
Packing random_packing(const ConvexSolid& solid, int n, double density, RandomStream& random);
/// Makes a random packing of the given particles, whose mean volume must be 1. The set of positions does not depend on
/// the order of `particles`.
Packing random_packing(std::span<const Particle> particles, double density, RandomStream& random);

/// The packing after an isotropic strain to another density. Centres move affinely, and orientations do not change.
Packing strained_to(const Packing& packing, double density);

/// The packing after a deformation F of its cell. Centres move affinely, and orientations do not change. Throws the
/// same exceptions as PeriodicCell::deformed().
Packing deformed(const Packing& packing, const DoubleDoubleMatrix& f);

/// The packing after a step of all its coordinates. The first 6N entries of `step` are (dx, R·dθ) for each particle, in
/// the lab frame, where R is the radius of gyration. A particle whose entries are all zero does not move. The other
/// entries, if there are any, are the free strains ℓ·ε of a CellFreedom; cell and centres are strained by exp(ε) before
/// the particles move.
Packing moved(const Packing& packing, const Eigen::VectorXd& step);

}  // namespace isojam
