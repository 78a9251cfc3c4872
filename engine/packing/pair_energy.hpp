#pragma once

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam {

/// Second derivatives of the energy of one touching pair, lab frame, per particle (x, R·θ), R its radius of gyration:
/// H(E) = ½ (g gᵀ + V H(V)), g = ∇V.
struct PairHessian {
  Matrix6d aa = Matrix6d::Zero(), ab = Matrix6d::Zero(), bb = Matrix6d::Zero();  ///< by (A, A), (A, B) and (B, B)
};

/// The energy E = V²/4 of one pair with its derivatives, coordinates as in PairHessian; Y·V_p.
struct PairEnergy {
  PairHessian hessian;                                                    ///< second derivatives
  Vector6d gradient_a = Vector6d::Zero(), gradient_b = Vector6d::Zero();  ///< first derivatives, (−F, −T/R)
  double energy = 0;                                                      ///< V²/4
};

/// The energy of A and B in double-double, with B's centre at r = x_B − x_A. Both must be placed in double-double.
PairEnergy pair_energy(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r);

/// The energy of a pair from its overlap, the overlap's Hessian, and the radii of gyration.
PairEnergy pair_energy(const Overlap& overlap, const OverlapHessian& hessian, const Eigen::Vector3d& r, double radius_a,
                       double radius_b);

}  // namespace isojam
