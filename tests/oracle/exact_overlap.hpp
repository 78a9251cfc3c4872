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

/// A number with 100 decimal digits. Sums over an intersection then retain the 60 digits of the solids, even if the
/// intersection is very thin.
using Real =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100>, boost::multiprecision::et_off>;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealMatrix = Eigen::Matrix<Real, 3, 3>;
using RealQuaternion = Eigen::Quaternion<Real>;

/// Pose of B in the body frame of A: y ↦ R y + displacement. R is the rotation by q/|q|. It is computed exactly, as a
/// rational function of the components of q, which may have any length except 0.
struct ExactPose {
  RealQuaternion quaternion{Real(1), Real(0), Real(0), Real(0)};
  RealVector displacement = RealVector::Zero();
};

/// The pose with exactly these components.
ExactPose exact_pose(const Eigen::Quaterniond& quaternion, const Eigen::Vector3d& displacement);
inline ExactPose exact_pose(const PairCase& pair) { return exact_pose(pair.quaternion, pair.displacement); }

/// The same pose for the engine: the exact rotation matrix and displacement, rounded once to double.
RelativePose rounded(const ExactPose& pose);

/// The pose of A in the body frame of B, which exchanges the two solids.
ExactPose inverse(const ExactPose& pose);

/// Upper limit of the displacement of a face plane by rounding errors of the pose and of the algorithm in double: 64
/// ulp of the size of the pair.
double plane_rounding(SolidKind a, SolidKind b);

/// The intersection of A and B with at least 30 correct digits. Vectors are in the body frame of A, and moments are
/// about its centre, as in isojam::Overlap.
struct ExactOverlap {
  Real volume = 0;
  RealVector area = RealVector::Zero();    ///< S_A = ∂V/∂x_A
  RealVector moment = RealVector::Zero();  ///< M_A = ∂V/∂θ_A
  /// False if a face of A and a face of B lie in one plane and share a part of the boundary. S and M are then
  /// discontinuous; the values here count the shared part as a part of A.
  bool single_valued = true;
  /// Upper limit of the effect of rounding on S: the area of those parts of the boundary that can belong to A or to B
  /// if the face planes move by plane_rounding(). It consists of strips along the contact loop, and of whole faces
  /// where faces of A and B nearly coincide.
  double contested_area = 0;
  /// bits of the faces of which a part with positive area bounds the intersection
  std::uint32_t faces_a = 0, faces_b = 0;
  /// bits of the edges of which a part with positive length bounds the intersection
  std::uint32_t edges_a = 0, edges_b = 0;
};

/// Computes the intersection as a convex hull in exact rational arithmetic (CGAL). The points are the vertices of each
/// solid inside the other one, and the points where an edge of one solid crosses a face of the other one. Only the
/// solids are approximate: √5 and the cube roots of the scales are rational numbers with errors of 1e-60. Throws
/// std::logic_error if a vertex of the engine's solids deviates by more than 1e-14 from the closed form. Throws
/// std::invalid_argument for a quaternion of length 0.
ExactOverlap exact_overlap(SolidKind a, SolidKind b, const ExactPose& pose);

/// The volume by an independent method: it cuts A with the face planes of B, one after another, in rational arithmetic.
Real exact_clipped_volume(SolidKind a, SolidKind b, const ExactPose& pose);

}  // namespace isojam::oracle
