#pragma once

#include <Eigen/Core>

#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

// Notation. A contact has the energy e of its relative pose, V²/4 (Smith, Fisher, Alam 2011). The ghost of B is B
// displaced rigidly by a shift w = (translation, R_B times twice the vector part of the unit quaternion) in B's body
// frame, R_B its radius of gyration. The ghost is fixed to B: moving A and B together as one body moves the ghost too
// and does not change w. A wrench is conjugate to w, and is therefore given in B's body frame too; in Y·V_p^(2/3).

/// Parameters of the Moreau envelope of a contact: its multiplier μ, a force, and a stiffness ρ that limits the
/// stiffness of the contact,
///   Φ = min_w [ e(w) + ½ ρ |w|² − μ·w ].
/// If the contact has exactly the force μ, ∇e = μ, then the ghost coincides with B, w = 0 and Φ = e. A contact much
/// stiffer than ρ behaves like a spring ρ about the force μ; a much softer one is unchanged (Moreau 1965; multiplier
/// method of Hestenes and Powell 1969 in the form of Rockafellar 1973).
struct ProximalTerms {
  Vector6d multiplier = Vector6d::Zero();  ///< μ
  double stiffness = 0;                    ///< ρ > 0, Y·V_p^(1/3)
};

/// The envelope of one contact in one pose, with its derivatives with respect to the poses of both bodies: per particle
/// (x, R·θ), lab frame, as in Evaluation::gradient.
struct ProximalContact {
  PairHessian ghost;                     ///< second derivatives of e with respect to A and the ghost
  Matrix6d root = Matrix6d::Identity();  ///< L of H_ww + ρ = L Lᵀ, lab frame
  Vector6d gradient_a = Vector6d::Zero(), gradient_b = Vector6d::Zero();  ///< gradient of Φ
  Vector6d shift = Vector6d::Zero();                                      ///< w at the minimum
  Vector6d wrench = Vector6d::Zero();                                     ///< ∇_w e = μ − ρ w at the minimum
  double value = 0;                                                       ///< Φ, Y·V_p
  double energy = 0;                                                      ///< e at the ghost
  int iterations = 0;                                                     ///< number of overlaps with Hessian
  bool touching = false;                                                  ///< true if A and the ghost touch
  bool converged = true;                                                  ///< false if Newton's method found no minimum

  /// Second derivatives of Φ: the Schur complement of H_ww + ρ in the second derivatives of e, to first order in w.
  PairHessian curvature() const;
  /// The same for another stiffness ρ and w = 0.
  PairHessian curvature(double stiffness) const;
  /// Φ after steps of A and B (x, R·θ), by its Taylor series to second order.
  double predicted(const Vector6d& a, const Vector6d& b) const;
  /// First-order change of w in the lab frame due to steps of A and B.
  Vector6d shift_change(const Vector6d& a, const Vector6d& b) const;
};

/// Computes the envelope of the contact of A with `solid_b`, whose centre is at r = x_B − x_A. `b` gives its
/// orientation. A must be placed in double-double. `start` is an estimate of the shift. Uses Newton's method in six
/// unknowns. Everything except its linear algebra is in double-double, because flat contacts transmit their force at a
/// depth of 1e-10.
ProximalContact proximal_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                 const DoubleDoubleVector& r, const ProximalTerms& terms, const Vector6d& start);

/// The contact in its present state: with the multiplier ∇e, for which the shift is 0.
ProximalContact unshifted_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                  const DoubleDoubleVector& r, double stiffness);

/// Transforms a shift or wrench from B's body frame to the lab frame.
Vector6d to_lab(const Pose& b, const Vector6d& w);
/// The inverse transformation.
Vector6d to_body(const Pose& b, const Vector6d& w);

}  // namespace isojam
