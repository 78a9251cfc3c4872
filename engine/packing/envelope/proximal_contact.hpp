#pragma once

#include <Eigen/Core>

#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

// A contact of A and B has the energy e = V²/4, which depends on the relative pose (Smith, Fisher, Alam 2011). The
// ghost of B is a copy of B that a rigid motion displaces from B. The shift w describes this motion by six numbers. The
// first three are the translation. The other three are 2 R_B v, where v is the vector part of the unit quaternion of
// the rotation and R_B is the radius of gyration of B. All components are in the body frame of B. If A and B move
// together as one rigid body, the ghost moves with them, and w does not change. Let e(w) be the energy of A and the
// ghost of B. The wrench is its derivative ∇_w e. The first three components of the wrench are the negative of the
// force on the ghost. At w = 0, the other three are the negative of the torque on the ghost, divided by R_B. The unit
// of a wrench is Y·V_p^(2/3).

/// Parameters of the Moreau envelope Φ of a contact,
///   Φ = min_w [ e(w) + ½ ρ |w|² − μ·w ].
/// The multiplier μ is an estimate of the wrench, and ρ is an upper limit of the stiffness of the envelope. If ∇_w e =
/// μ at w = 0, then the minimum is at w = 0: the ghost coincides with B, and Φ = e. If the contact is much stiffer than
/// ρ, Φ is approximately the energy of a spring with stiffness ρ. This spring is already loaded when A and B just
/// touch: the derivative of Φ with respect to the displacement of B is then μ. If the contact is much softer than ρ, Φ
/// is approximately e (Moreau 1965; method of multipliers of Hestenes and Powell 1969 in the form of Rockafellar 1973).
struct ProximalTerms {
  Vector6d multiplier = Vector6d::Zero();  ///< multiplier μ
  double stiffness = 0;                    ///< stiffness ρ > 0, in units of Y·V_p^(1/3)
  /// Let F(w) be the function in the brackets above. If its residual |∇F| / (|∇e| + |μ|) is below this number, Newton's
  /// method makes one more step and computes no further overlap. The value and the gradients then follow from the
  /// Taylor series about the last overlap. Their relative errors are of the order of the square of this number.
  double series_below = 0;
};

/// The envelope of one contact in one state, and its derivatives with respect to the coordinates (x, R·θ) of both
/// particles in the lab frame, as in Evaluation::gradient.
struct ProximalContact {
  PairHessian ghost;  ///< second derivatives of e with respect to the coordinates of A and of the ghost, lab frame
  /// Cholesky factor L of the second derivatives of e(w) + ½ ρ |w|² − μ·w with respect to the coordinates of the ghost;
  /// at w = 0 they are the second derivatives of e plus ρ·1. If they are not positive definite, a multiple of the unit
  /// matrix is added first.
  Matrix6d root = Matrix6d::Identity();
  Vector6d gradient_a = Vector6d::Zero(), gradient_b = Vector6d::Zero();  ///< gradient of Φ, lab frame
  Vector6d shift = Vector6d::Zero();                                      ///< shift w at the minimum, body frame of B
  Vector6d wrench = Vector6d::Zero();  ///< wrench ∇_w e = μ − ρ w at the minimum, body frame of B
  double value = 0;                    ///< Φ, in units of Y·V_p
  double energy = 0;                   ///< energy e of A and the ghost of B
  int iterations = 0;                  ///< number of overlaps with Hessian that were computed
  bool touching = false;               ///< true if A touches the ghost of B
  bool converged = true;               ///< false if Newton's method found no minimum
  /// true if there is no envelope, so that Φ = e (plain_contact()); `root` is then not set
  bool plain = false;

  /// Second derivatives of Φ, computed by eliminating w from the second derivatives of e(w) + ½ ρ |w|² − μ·w. Their
  /// relative error is proportional to |w|.
  PairHessian curvature() const;
  /// Second derivatives of Φ for another stiffness ρ, from the present second derivatives of e, as if w were 0.
  PairHessian curvature(double stiffness) const;
  /// Estimates Φ after the steps a and b of the coordinates (x, R·θ) of A and B, from the gradient and curvature().
  double predicted(const Vector6d& a, const Vector6d& b) const;
  /// Change of w in the lab frame after the steps a and b, to first order.
  Vector6d shift_change(const Vector6d& a, const Vector6d& b) const;
};

/// Computes the envelope of a contact of A and `solid_b`, where r = x_B − x_A and `b` gives the orientation of B. A
/// must have been placed in double-double. `start` is an estimate of the shift. Newton's method finds w. Positions,
/// orientations and small distances between the solids are computed in double-double, because the depth of a flat
/// contact near jamming is about 1e-10 V_p^(1/3). The shift, forces and Φ are doubles.
ProximalContact proximal_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                 const DoubleDoubleVector& r, const ProximalTerms& terms, const Vector6d& start);

/// Computes the envelope with the multiplier μ = ∇_w e. The shift is then 0, and Φ = e.
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
