#include "engine/geometry/pose.hpp"

#include <cmath>

namespace isojam {

RelativePose relative_pose(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b,
                           const Eigen::Vector3d& displacement) {
  const Eigen::Quaterniond to_a = a.conjugate();
  return {(to_a * b).toRotationMatrix(), to_a * displacement};
}

Eigen::Quaterniond rotated(const Eigen::Quaterniond& q, const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  // sin(θ/2)/θ → 1/2 without a division by zero.
  const double half_sinc = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
  Eigen::Quaterniond turn;
  turn.w() = std::cos(angle / 2);
  turn.vec() = half_sinc * theta;
  return (turn * q).normalized();
}

}  // namespace isojam
