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
  Composition solids;       ///< of every particle
  PeriodicCell cell;        ///< that it repeats in
  std::vector<Pose> poses;  ///< centre and orientation of every particle

  int size() const { return static_cast<int>(poses.size()); }  ///< N
  double density() const { return size() / cell.volume(); }    ///< φ = N V_p/V_cell
};

/// Random packing of n particles at density φ in a cube: positions uniform in the cell, orientations uniform on SO(3).
/// Numbered along a curve through the cell, so that neighbours have near numbers. Throws std::invalid_argument if n <
/// 1, φ is not in (0, 1], or the cell is not larger than least_side(solid).
Packing random_packing(const ConvexSolid& solid, int n, double density, RandomStream& random);
/// The same of these particles, whose volumes have mean 1: any of them is as likely to stand anywhere.
Packing random_packing(std::span<const Particle> particles, double density, RandomStream& random);

/// The packing at another density: isotropic strain moves centres affinely and leaves orientations alone.
Packing strained_to(const Packing& packing, double density);

/// The packing in its cell deformed by F, which may throw as PeriodicCell::deformed() does: centres move affinely,
/// orientations stay.
Packing deformed(const Packing& packing, const DoubleDoubleMatrix& f);

/// Moves every particle whose entries are not all zero: step has 6N, per particle (dx, R·dθ), lab frame, R its radius
/// of gyration. Entries after these are ℓ·ε of the strains that are free, as many as CellFreedom has: cell and centres
/// are strained by exp(ε) first.
Packing moved(const Packing& packing, const Eigen::VectorXd& step);

}  // namespace isojam
