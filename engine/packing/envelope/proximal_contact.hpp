#pragma once

#include <Eigen/Core>

#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

// Notation. A contact has the energy e of its relative pose, V²/4 (Smith, Fisher, Alam 2011). The ghost of B is B moved
// rigidly by a shift w = (translation, R_B times twice the vector part of the unit quaternion) in B's body frame,
// R_B its radius of gyration. It is fixed to B: moving A and B together as one body takes the ghost along and leaves w
// as it is. A wrench is conjugate to w, and so is given in B's body frame too; in Y·V_p^(2/3).

/// What the Moreau envelope of a contact is taken with: a force of its own, the multiplier μ, and a stiffness ρ beyond
/// which the contact gives way,
///   Φ = min_w [ e(w) + ½ ρ |w|² − μ·w ].
/// A contact that bears just the force μ, ∇e = μ, has its ghost in its place, w = 0 and Φ = e. Contacts much stiffer
/// than ρ have become springs ρ about the force μ; contacts much softer are what they were (Moreau 1965; the multiplier
/// method of Hestenes and Powell 1969 as Rockafellar 1973 has it).
struct ProximalTerms {
  Vector6d multiplier = Vector6d::Zero();  ///< μ
  double stiffness = 0;                    ///< ρ > 0, Y·V_p^(1/3)
};

/// The envelope of one contact in one pose, and how it changes with the poses of both bodies: per particle (x, R·θ),
/// lab frame, as in Evaluation::gradient.
struct ProximalContact {
  PairHessian ghost;                     ///< second derivatives of e by A and the ghost
  Matrix6d root = Matrix6d::Identity();  ///< L of H_ww + ρ = L Lᵀ, lab frame
  Vector6d gradient_a = Vector6d::Zero(), gradient_b = Vector6d::Zero();  ///< of Φ
  Vector6d shift = Vector6d::Zero();                                      ///< w at the minimum
  Vector6d wrench = Vector6d::Zero();                                     ///< ∇_w e = μ − ρ w there
  double value = 0;                                                       ///< Φ, Y·V_p
  double energy = 0;                                                      ///< e at the ghost
  int iterations = 0;                                                     ///< overlaps with Hessian that it took
  bool touching = false;                                                  ///< A and the ghost
  bool converged = true;                                                  ///< false if Newton's method found no minimum

  /// Second derivatives of Φ: the Schur complement of H_ww + ρ in those of e, to first order in w.
  PairHessian curvature() const;
  /// The same for another stiffness ρ and w = 0.
  PairHessian curvature(double stiffness) const;
  /// Φ after steps of A and B (x, R·θ) by its series to second order.
  double predicted(const Vector6d& a, const Vector6d& b) const;
  /// Change of w in the lab frame by steps of A and B, to first order.
  Vector6d shift_change(const Vector6d& a, const Vector6d& b) const;
};

/// Finds the envelope of the contact of A with `solid_b`, whose centre is at r = x_B − x_A; `b` gives its orientation,
/// in double-double as A was placed. `start`: first guess of the shift. Newton's method in six unknowns, in
/// double-double but for its linear algebra: flat contacts bear their force at a depth of 1e-10.
ProximalContact proximal_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                 const DoubleDoubleVector& r, const ProximalTerms& terms, const Vector6d& start);

/// The contact as it is: with the multiplier ∇e, which leaves the ghost in its place.
ProximalContact unshifted_contact(const PlacedSolid& a, const ConvexSolid& solid_b, const Pose& b,
                                  const DoubleDoubleVector& r, double stiffness);

/// A shift or wrench from B's body frame to the lab frame.
Vector6d to_lab(const Pose& b, const Vector6d& w);
/// The other way round.
Vector6d to_body(const Pose& b, const Vector6d& w);

}  // namespace isojam
