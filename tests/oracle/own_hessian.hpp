#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam::oracle {

inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The block H_AB of the Hessian of V, in the body frame of A.
inline Matrix6d overlap_cross_hessian(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  SeparatingAxis unused;
  OverlapHessian hessian;
  overlap_with_hessian(LonePlacedSolid(a, Eigen::Matrix3d(Eigen::Matrix3d::Identity())),
                       LonePlacedSolid(b, pose.rotation), pose.displacement, unused, hessian);
  return hessian.ab;
}

/// The block ∂²V/∂(x_A, θ_A)², by the formula in the comment of OverlapHessian. For the block of B, exchange the
/// solids: pass the transpose of H_AB, S_B = −S_A, and −r.
inline Matrix6d own_hessian(const Matrix6d& cross, const Eigen::Vector3d& area, const Eigen::Vector3d& r) {
  Matrix6d transport = Matrix6d::Identity();
  transport.topRightCorner<3, 3>() = -skew(r);
  Matrix6d own = -cross * transport;
  own.topRightCorner<3, 3>() -= skew(area);
  return (own + own.transpose()) / 2;
}

}  // namespace isojam::oracle
