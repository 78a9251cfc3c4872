#pragma once

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam {

/// Second derivatives of the energy of one touching pair, H(E) = ½ (g gᵀ + V H(V)), where V is the overlap volume, H(V)
/// its Hessian and g = ∇V. Each particle has the six coordinates (x, R·θ), where R is its radius of gyration; vectors
/// are in the lab frame.
struct PairHessian {
  /// 6 × 6 blocks for the coordinates of (A, A), (A, B) and (B, B)
  Matrix6d aa = Matrix6d::Zero(), ab = Matrix6d::Zero(), bb = Matrix6d::Zero();
};

/// The energy E = V²/4 of one pair and its derivatives with respect to the coordinates of PairHessian. The energy is in
/// units of Y·V_p.
struct PairEnergy {
  PairHessian hessian;  ///< second derivatives of E
  /// first derivatives (−F, −T/R) of E, with force F and torque T
  Vector6d gradient_a = Vector6d::Zero(), gradient_b = Vector6d::Zero();
  double energy = 0;  ///< V²/4
};

/// Computes the energy of the solids A and B, whose centres have the displacement r = x_B − x_A. Both solids must have
/// been placed in double-double.
PairEnergy pair_energy(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r);

/// Computes the energy of a pair from the overlap, the Hessian of the overlap volume, the displacement r, and the radii
/// of gyration of A and B.
PairEnergy pair_energy(const Overlap& overlap, const OverlapHessian& hessian, const Eigen::Vector3d& r, double radius_a,
                       double radius_b);

}  // namespace isojam
