#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cstdint>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "tasks/extras/chart/pairs/pair_cases.hpp"

namespace isojam::oracle {

/// 100 decimal digits: sums over an intersection then keep the solids' own 60 digits, even for very thin intersections.
using Real =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100>, boost::multiprecision::et_off>;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealMatrix = Eigen::Matrix<Real, 3, 3>;
using RealQuaternion = Eigen::Quaternion<Real>;

/// Pose of B in A's body frame: y ↦ R y + displacement, R the rotation by q/|q|. q must not be zero, and need not be a
/// unit quaternion; R is the exact rational matrix of its components.
struct ExactPose {
  RealQuaternion quaternion{Real(1), Real(0), Real(0), Real(0)};
  RealVector displacement = RealVector::Zero();
};

/// The pose that these doubles represent exactly.
ExactPose exact_pose(const Eigen::Quaterniond& quaternion, const Eigen::Vector3d& displacement);
inline ExactPose exact_pose(const PairCase& pair) { return exact_pose(pair.quaternion, pair.displacement); }

/// The same pose with its exact rotation matrix rounded to double once: the input of the engine.
RelativePose rounded(const ExactPose& pose);

/// A as seen from B (lengths V_p^(1/3), rotation inverted): exchanges the two solids.
ExactPose inverse(const ExactPose& pose);

/// Upper limit of the displacement of a face plane by rounding errors in double, of the pose and of the algorithm: 64
/// ulp of the size of the pair.
double plane_rounding(SolidKind a, SolidKind b);

/// Intersection of A and B to at least 30 digits; conventions of isojam::Overlap (A's body frame, A's centre).
struct ExactOverlap {
  Real volume = 0;
  RealVector area = RealVector::Zero();    ///< S_A = ∂V/∂x_A
  RealVector moment = RealVector::Zero();  ///< M_A = ∂V/∂θ_A
  /// False if a face of A and one of B share a piece of the boundary (or touch along it). S and M are then one-sided,
  /// and the values count the shared piece as A's.
  bool single_valued = true;
  /// Area of the boundary that may change between A and B if the face planes move by plane_rounding(): strips along the
  /// contact loop, and whole facets where faces of A and B nearly coincide. An upper limit of the effect of rounding on
  /// S.
  double contested_area = 0;
  std::uint32_t faces_a = 0, faces_b = 0;  ///< faces with a piece of positive area on the intersection
  std::uint32_t edges_a = 0, edges_b = 0;  ///< edges with a piece of positive length on it
};

/// Convex hull, in exact rational arithmetic (CGAL), of the vertices of either solid inside the other and of the points
/// where an edge of one crosses a face of the other. The only approximation is in the solids: √5 and the cube roots of
/// the unit-volume scale are rationals with errors of 1e-60, the same for A and B. Throws std::logic_error if the
/// engine's vertices are not within 1e-14 of the closed forms, std::invalid_argument for a zero quaternion.
ExactOverlap exact_overlap(SolidKind a, SolidKind b, const ExactPose& pose);

/// The volume by an independent method: A cut in rational arithmetic by one face plane of B after another.
Real exact_clipped_volume(SolidKind a, SolidKind b, const ExactPose& pose);

}  // namespace isojam::oracle
