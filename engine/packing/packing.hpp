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

/// A packing: N particles of mean volume V_p = 1 in a periodic cell. It is a value type, whose positions are not
/// wrapped into the cell.
struct Packing {
  Composition solids;       ///< the solid of every particle
  PeriodicCell cell;        ///< the periodic cell
  std::vector<Pose> poses;  ///< centre and orientation of every particle

  int size() const { return static_cast<int>(poses.size()); }  ///< N
  double density() const { return size() / cell.volume(); }    ///< φ = N V_p/V_cell
};

/// Makes a random packing of n particles at density φ in a cube. Positions are uniform in the cell, and orientations
/// are uniform on SO(3). Particles are numbered along a space-filling curve, so that neighbours have similar numbers.
/// Throws std::invalid_argument if n < 1, if φ is not in (0, 1], or if the side of the cube is not larger than
/// least_side(solid).
Packing random_packing(const ConvexSolid& solid, int n, double density, RandomStream& random);
/// Makes a random packing of the given particles, whose mean volume must be 1. The positions and orientations depend
/// only on N, φ and `random`. Throws std::invalid_argument if the list is empty, if φ is not in (0, 1], or if the cube
/// is not legal for the particles (is_legal() in cell/periodic_cell.hpp).
Packing random_packing(std::span<const Particle> particles, double density, RandomStream& random);

/// The packing after an isotropic strain to another density. Centres move affinely, and orientations do not change.
Packing strained_to(const Packing& packing, double density);

/// The packing after a deformation F of its cell. Centres move affinely, and orientations do not change. Throws
/// std::invalid_argument unless the new lattice vectors are finite and right-handed.
Packing deformed(const Packing& packing, const DoubleDoubleMatrix& f);

/// The packing after a step. In engine/, a step is a vector of changes of all coordinates. Its first 6N entries are
/// (dx, R·dθ) for each particle, in the lab frame, where R is the radius of gyration. If the cell has free strains,
/// their coordinates ℓ·ε in the basis strain_basis() follow as 1, 5 or 6 more entries, with ℓ = strain_length()
/// (cell/control.hpp). First, exp(ε) strains the cell and moves the centres affinely. Then the particles move by dx and
/// rotate by dθ. If all entries of a particle are zero, its pose is exactly the pose that the strain alone gives.
Packing moved(const Packing& packing, const Eigen::VectorXd& step);

}  // namespace isojam
