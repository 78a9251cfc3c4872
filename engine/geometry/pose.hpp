#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace isojam {

/// Position of the centre (V_p^(1/3)) and orientation (unit quaternion, body frame → lab frame) of a particle.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Solid B seen from the body frame of A: a point y of B's body frame lies at rotation·y + displacement.
struct RelativePose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
};

/// Relative pose of B at `displacement` = x_B − x_A (lab frame, periodic image already chosen).
RelativePose relative_pose(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b,
                           const Eigen::Vector3d& displacement);

/// exp(θ)·q, θ a rotation vector in the lab frame (radians); the result is normalised.
Eigen::Quaterniond rotated(const Eigen::Quaterniond& q, const Eigen::Vector3d& theta);

}  // namespace isojam
