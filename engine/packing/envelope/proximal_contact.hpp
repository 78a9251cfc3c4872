#pragma once

#include <Eigen/Core>

#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

// Terms. A contact of A and B has the energy e = V²/4, which depends on the relative pose (Smith, Fisher, Alam 2011).
// The ghost of B is a copy of B that is displaced from B by a rigid motion, the shift w. The first three components of
// w are the translation. The other three are 2 R_B v, where v is the vector part of the unit quaternion of the rotation
// and R_B is the radius of gyration of B. All components are in the body frame of B. If A and B move together as one
// rigid body, the ghost moves with them, and w does not change. A wrench consists of a force, and of a torque divided
// by R_B. It is conjugate to w, so it is also in the body frame of B. Its unit is Y·V_p^(2/3).

/// Parameters of the Moreau envelope Φ of a contact,
///   Φ = min_w [ e(w) + ½ ρ |w|² − μ·w ].
/// The multiplier μ is an estimate of the wrench, and ρ is an upper limit of the stiffness. If the wrench of the
/// contact is exactly the multiplier, ∇e = μ, then the minimum is at w = 0: the ghost coincides with B, and Φ = e. A
/// contact that is much stiffer than ρ has approximately the envelope of a spring with stiffness ρ and force μ. The
/// envelope of a much softer contact is approximately its energy (Moreau 1965; method of multipliers of Hestenes and
/// Powell 1969 in the form of Rockafellar 1973).
struct ProximalTerms {
  Vector6d multiplier = Vector6d::Zero();  ///< multiplier μ
  double stiffness = 0;                    ///< stiffness ρ > 0, in units of Y·V_p^(1/3)
  /// If the residual |∇F| / (|∇e| + |μ|) is below this, the last Newton step for w takes the value and the gradients from
  /// the Taylor series about the last overlap instead of from another overlap. Their relative errors are of the order of
  /// the square of this number.
  double series_below = 0;
};

/// The envelope of one contact in one state, and its derivatives with respect to the coordinates (x, R·θ) of both
/// particles in the lab frame, as in Evaluation::gradient.
struct ProximalContact {
  PairHessian ghost;  ///< second derivatives of e with respect to A and the ghost, lab frame
  /// Cholesky factor L of H_ww + ρ·1 = L Lᵀ, where H_ww are the second derivatives of e with respect to w; lab frame
  Matrix6d root = Matrix6d::Identity();
  Vector6d gradient_a = Vector6d::Zero(), gradient_b = Vector6d::Zero();  ///< gradient of Φ, lab frame
  Vector6d shift = Vector6d::Zero();                                      ///< shift w at the minimum, body frame of B
  Vector6d wrench = Vector6d::Zero();  ///< wrench ∇_w e = μ − ρ w at the minimum, body frame of B
  double value = 0;                    ///< Φ, in units of Y·V_p
  double energy = 0;                   ///< energy e of A and the ghost of B
  int iterations = 0;                  ///< number of overlaps with Hessian that were computed
  bool touching = false;               ///< true if A touches the ghost of B
  bool converged = true;               ///< false if Newton's method found no minimum
  /// true for the contact itself, Φ = e, without an envelope; `root` is then not set
  bool plain = false;

  /// Second derivatives of Φ: the Schur complement of H_ww + ρ·1 in the second derivatives of e. They are exact to
  /// first order in w.
  PairHessian curvature() const;
  /// Second derivatives of Φ for another stiffness ρ and w = 0.
  PairHessian curvature(double stiffness) const;
  /// Φ after the steps a and b of the coordinates (x, R·θ) of A and B, by a Taylor series to second order.
  double predicted(const Vector6d& a, const Vector6d& b) const;
  /// Change of w in the lab frame after the steps a and b, to first order.
  Vector6d shift_change(const Vector6d& a, const Vector6d& b) const;
};

/// Computes the envelope of a contact of A and `solid_b`, where r = x_B − x_A and `b` gives the orientation of B. A
/// must have been placed in double-double. `start` is an estimate of the shift. The function finds w by Newton's method
/// with six unknowns. Everything except the linear algebra is computed in double-double, because flat contacts carry
/// their force at a depth of 1e-10.
ProximalContact proximal_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                 const DoubleDoubleVector& r, const ProximalTerms& terms, const Vector6d& start);

/// The envelope of a contact with the multiplier μ = ∇e, for which the shift is 0.
ProximalContact unshifted_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                  const DoubleDoubleVector& r, double stiffness);

/// The contact itself: Φ = e, the shift is 0, and the stiffness is not limited. `b` gives the orientation of
/// `placed_b`, and both solids must have been placed in double-double.
ProximalContact plain_contact(const PlacedSolid& a, const PlacedSolid& placed_b, const Pose& b,
                              const DoubleDoubleVector& r);

/// Transforms a shift or a wrench from the body frame of B to the lab frame.
Vector6d to_lab(const Pose& b, const Vector6d& w);
/// Transforms a shift or a wrench from the lab frame to the body frame of B.
Vector6d to_body(const Pose& b, const Vector6d& w);

}  // namespace isojam
