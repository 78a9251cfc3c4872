#pragma once

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam {

/// Second derivatives of the energy of one touching pair, H(E) = ½ (g gᵀ + V H(V)). V is the overlap volume, g its
/// gradient and H(V) its Hessian. Each particle has the six coordinates (x, R·θ), where R is its radius of gyration.
/// Vectors are in the lab frame.
struct PairHessian {
  /// 6 × 6 blocks for the coordinates of (A, A), (A, B) and (B, B)
  Matrix6d aa = Matrix6d::Zero(), ab = Matrix6d::Zero(), bb = Matrix6d::Zero();
};

/// The energy E = V²/4 of one pair, in units of Y·V_p, and its derivatives with respect to the coordinates of
/// PairHessian.
struct PairEnergy {
  PairHessian hessian;  ///< second derivatives of E
  /// first derivatives (−F, −T/R) of E for A and B; F is the force and T the torque on the particle
  Vector6d gradient_a = Vector6d::Zero(), gradient_b = Vector6d::Zero();
  double energy = 0;  ///< V²/4
};

/// Computes the energy of a pair of solids A and B, where r = x_B − x_A. Both solids must have been placed in
/// double-double. If they do not touch, the energy and all derivatives are 0.
PairEnergy pair_energy(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r);

/// Computes the energy of a pair from the overlap and the Hessian of the overlap volume, both in the lab frame. r is
/// the displacement x_B − x_A, and `radius_a` and `radius_b` are the radii of gyration.
PairEnergy pair_energy(const Overlap& overlap, const OverlapHessian& hessian, const Eigen::Vector3d& r, double radius_a,
                       double radius_b);

/// The second derivatives of V with respect to the same coordinates.
PairHessian volume_hessian(const OverlapHessian& hessian, double radius_a, double radius_b);

}  // namespace isojam
