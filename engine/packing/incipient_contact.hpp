#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/packing/cell/control.hpp"

namespace isojam {

/// Overlap volume V of a pair (a, b), to first order in a step s in the format of moved(): V ≈ at_rest + slope_a·s_a +
/// slope_b·s_b + slope_strains·ε. V is in units of V_p, slopes are in units of V_p^(2/3).
struct LinearisedOverlap {
  double at_rest = 0;  ///< V for s = 0
  /// derivatives with respect to the steps of a and of b
  Vector6d slope_a = Vector6d::Zero(), slope_b = Vector6d::Zero();
  /// derivatives with respect to the free strains; empty if there are none
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> slope_strains{};

  /// V of the pair (a, b) after a step of the whole packing.
  double at(const Eigen::VectorXd& step, int a, int b) const {
    const double by_particles = at_rest + slope_a.dot(step.segment<6>(6 * a)) + slope_b.dot(step.segment<6>(6 * b));
    if (slope_strains.size() == 0) return by_particles;
    return by_particles + slope_strains.dot(step.tail(slope_strains.size()));
  }
};

/// A pair of particles that touch, or would touch if their centres were closer by the probe distance. V is linearised
/// in two states: the present state, and the state in which the centres are closer by the probe distance. If two faces
/// are almost coplanar, the tangent in the second state is much steeper. Both tangents are lower bounds of V, because V
/// of a flat contact is a convex function of depth and tilt.
struct IncipientContact {
  int a = 0, b = 0;       ///< particles
  LinearisedOverlap now;  ///< tangent in the present state; 0 if the pair does not touch
  /// Tangent in the state with closer centres, extrapolated to the present state. There its value is negative if the
  /// pair has a gap. 0 if the pair does not touch even with closer centres.
  LinearisedOverlap closed;
  /// Stiffness of a flat contact against relative_rotation(). The contact has this stiffness only if the line in which
  /// the two face planes intersect crosses the face. Otherwise V is linear in the tilt, so the Hessian does not contain
  /// this stiffness.
  Eigen::Matrix3d tilt = Eigen::Matrix3d::Zero();
  double rotation_scale_a = 1, rotation_scale_b = 1;  ///< √(R_A R_B)/R for each particle

  /// Relative rotation √(R_A R_B) (θ_B − θ_A) of the pair in a step.
  Eigen::Vector3d relative_rotation(const Eigen::VectorXd& step) const {
    return rotation_scale_b * step.segment<3>(6 * b + 3) - rotation_scale_a * step.segment<3>(6 * a + 3);
  }
};

/// Radii of gyration of the two particles of a pair.
struct GyrationRadii {
  double a, b;  ///< radii of A and of B, V_p^(1/3)
};

/// Computes the tangent of V from an overlap, whose vector area S_A and moment M_A are in the lab frame. r is the
/// displacement x_B − x_A.
LinearisedOverlap tangent(const Overlap& overlap, const Eigen::Vector3d& r, const GyrationRadii& radii);

/// Makes the IncipientContact of a pair. `now` is the overlap at displacement r. `closed` is the overlap with the
/// centre of B closer to the centre of A by `probe_distance` (V_p^(1/3)). At least one of the two overlaps must not be
/// empty. `strains` is the basis of the free strains, divided by ℓ.
IncipientContact incipient_contact(int a, int b, const Overlap& now, const Overlap& closed, const Eigen::Vector3d& r,
                                   double probe_distance, const GyrationRadii& radii, const StrainBasis& strains = {});

}  // namespace isojam
