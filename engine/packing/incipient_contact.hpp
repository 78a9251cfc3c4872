#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/packing/cell/control.hpp"

namespace isojam {

/// Overlap volume of a pair (a, b) to first order in a step s of moved(): per particle (x, R·θ), R its radius of
/// gyration, followed by the free strains ℓ·ε. V ≈ at_rest + slope_a·s_a + slope_b·s_b + slope_strains·ε. V in V_p,
/// slopes in V_p^(2/3).
struct LinearisedOverlap {
  double at_rest = 0;                                                 ///< V at s = 0
  Vector6d slope_a = Vector6d::Zero(), slope_b = Vector6d::Zero();    ///< with respect to the steps of a and b
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> slope_strains{};  ///< by the free strains; empty without

  /// V after a step of the whole packing, for the pair (a, b).
  double at(const Eigen::VectorXd& step, int a, int b) const {
    const double by_particles = at_rest + slope_a.dot(step.segment<6>(6 * a)) + slope_b.dot(step.segment<6>(6 * b));
    if (slope_strains.size() == 0) return by_particles;
    return by_particles + slope_strains.dot(step.tail(slope_strains.size()));
  }
};

/// A pair of particles that touch, or would touch if their centres were closer by the probe distance. V is linearised
/// twice: in the present state, and with the gap closed by the probe distance. If two faces are about to become
/// coplanar, the second tangent is far steeper. Both tangents are lower bounds, because V of a flat contact is convex
/// in depth and tilt.
struct IncipientContact {
  int a = 0, b = 0;       ///< particles
  LinearisedOverlap now;  ///< tangent in the present state; 0 if the pair does not touch
  /// Tangent with the gap closed, extrapolated to the present state, where it is negative for a gap; 0 if the pair
  /// still does not touch.
  LinearisedOverlap closed;
  /// Stiffness against the relative rotation relative_turn() that a flat contact has once its section line crosses the
  /// face. Before that V is linear in the tilt, so that the Hessian does not contain this stiffness.
  Eigen::Matrix3d tilt = Eigen::Matrix3d::Zero();
  double turn_a = 1, turn_b = 1;  ///< √(R_A R_B)/R for each particle

  /// √(R_A R_B) (θ_B − θ_A).
  Eigen::Vector3d relative_turn(const Eigen::VectorXd& step) const {
    return turn_b * step.segment<3>(6 * b + 3) - turn_a * step.segment<3>(6 * a + 3);
  }
};

/// Radii of gyration of a pair.
struct GyrationRadii {
  double a, b;  ///< radii of A and of B, V_p^(1/3)
};

/// Tangent of V for an overlap (vector area S_A and moment M_A in the lab frame) at displacement r = x_B − x_A.
LinearisedOverlap tangent(const Overlap& overlap, const Eigen::Vector3d& r, const GyrationRadii& radii);

/// The pair with overlap `now` at displacement r, and overlap `closed` with B's centre closer to A's by
/// `probe_distance` (V_p^(1/3)). At least one of them must not be empty. `strains`: basis of the free strains, divided
/// by ℓ.
IncipientContact incipient_contact(int a, int b, const Overlap& now, const Overlap& closed, const Eigen::Vector3d& r,
                                   double probe_distance, const GyrationRadii& radii, const StrainBasis& strains = {});

}  // namespace isojam
