#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/packing/cell/control.hpp"

namespace isojam {

/// Overlap volume V of a pair of particles a and b as a linear function of a step of the packing. packing.hpp defines a
/// step: s_a and s_b are its entries for a and b, and s_ε are its last entries, the coordinates ℓ·ε of the free strains
/// with ℓ = strain_length() (cell/control.hpp).
///   V ≈ at_rest + slope_a·s_a + slope_b·s_b + slope_strains·s_ε
/// V is in units of V_p, and slopes are in units of V_p^(2/3).
struct LinearisedOverlap {
  double at_rest = 0;  ///< V for the step 0
  /// derivatives with respect to s_a and s_b
  Vector6d slope_a = Vector6d::Zero(), slope_b = Vector6d::Zero();
  /// derivatives with respect to s_ε; empty if there are no free strains
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> slope_strains{};

  /// V of the pair (a, b) after a step of the packing.
  double at(const Eigen::VectorXd& step, int a, int b) const {
    const double by_particles = at_rest + slope_a.dot(step.segment<6>(6 * a)) + slope_b.dot(step.segment<6>(6 * b));
    if (slope_strains.size() == 0) return by_particles;
    return by_particles + slope_strains.dot(step.tail(slope_strains.size()));
  }
};

/// A pair of particles that touch, or that would touch if their centres were closer by the probe distance. V is
/// linearised twice: in the present state, and in the closed state. The closed state is the present state with the
/// centre of b closer to the centre of a by the probe distance. The present tangent alone is not sufficient. It is 0 if
/// the pair has a gap. Its slope is much too small if a vertex touches a face and the next step makes two faces
/// coplanar. In a flat contact, two faces are almost coplanar. If only its depth and its tilt change, V is convex, and
/// both tangents are lower bounds of V. Sliding changes V little, because the depth is small.
struct IncipientContact {
  int a = 0, b = 0;       ///< indices of the particles
  LinearisedOverlap now;  ///< tangent in the present state; zero if the pair does not touch
  /// Tangent in the closed state, as a function of a step from the present state. If the pair has a gap, `at_rest` is
  /// negative. The tangent is zero if the pair does not touch in the closed state, or if the probe distance is 0.
  LinearisedOverlap closed;
  /// Estimated stiffness matrix for the coordinates relative_rotation(), in units of Y·V_p^(1/3). It assumes a flat
  /// contact whose two face planes intersect in a line through the centre of the contact. For rotations about all axes
  /// in the plane of the faces, the estimate is |S|³/(50 R_a R_b). About the normal of the plane, it is 0. S is the
  /// larger vector area of the present and the closed state. The matrix is computed for every pair, but a pair has this
  /// stiffness only if the line crosses the faces. If the line does not cross the faces in the present state, V is a
  /// linear function of the rotation, and the Hessian does not contain this stiffness. After the step, the line may
  /// nevertheless cross the faces.
  Eigen::Matrix3d tilt = Eigen::Matrix3d::Zero();
  /// √(R_a R_b)/R_a and √(R_a R_b)/R_b, where R_a and R_b are the radii of gyration
  double rotation_scale_a = 1, rotation_scale_b = 1;

  /// Relative rotation √(R_a R_b) (θ_b − θ_a) of the pair in a step, where θ are the rotations of the particles.
  Eigen::Vector3d relative_rotation(const Eigen::VectorXd& step) const {
    return rotation_scale_b * step.segment<3>(6 * b + 3) - rotation_scale_a * step.segment<3>(6 * a + 3);
  }
};

/// Radii of gyration of the two particles of a pair, in units of V_p^(1/3).
struct GyrationRadii {
  double a, b;  ///< radius of the particle
};

/// Computes the tangent of V in the state for which `overlap` was computed, without slope_strains. Vectors of `overlap`
/// must be in the lab frame, and r is the displacement x_b − x_a of this state.
LinearisedOverlap tangent(const Overlap& overlap, const Eigen::Vector3d& r, const GyrationRadii& radii);

/// Makes the IncipientContact of a pair. `now` is the overlap in the present state, where the displacement x_b − x_a is
/// r. `closed` is the overlap in the closed state, for the probe distance `probe_distance` (V_p^(1/3)). Vectors of both
/// overlaps must be in the lab frame. An overlap is empty if the pair does not touch. `strains` is the basis of the
/// free strains divided by ℓ: strain_basis()/strain_length(), see cell/control.hpp.
IncipientContact incipient_contact(int a, int b, const Overlap& now, const Overlap& closed, const Eigen::Vector3d& r,
                                   double probe_distance, const GyrationRadii& radii, const StrainBasis& strains = {});

}  // namespace isojam
