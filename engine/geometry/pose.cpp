#include "engine/geometry/pose.hpp"

#include <cmath>

namespace isojam {

RelativePose relative_pose(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b,
                           const Eigen::Vector3d& displacement) {
  const Eigen::Quaterniond to_a = a.conjugate();
  return {(to_a * b).toRotationMatrix(), to_a * displacement};
}

namespace {

/// sin(|θ|/2)/|θ| → 1/2 without a division by zero.
double half_sinc(double angle) { return angle > 0 ? std::sin(angle / 2) / angle : 0.5; }

void store(Pose& pose, int c, const TwoDouble& value) {
  pose.orientation.coeffs()[c] = value.high;
  pose.orientation_low[c] = value.low;
}

void normalise(Pose& pose) {
  TwoDouble square;
  for (int c = 0; c < 4; ++c) square = square + pose.component(c) * pose.component(c);
  const TwoDouble inverse = reciprocal_sqrt(square);
  for (int c = 0; c < 4; ++c) store(pose, c, pose.component(c) * inverse);
}

}  // namespace

Pose moved(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Vector3d& theta) {
  Pose result = pose;
  const double angle = theta.norm();
  // exp(θ) − 1, so that a small turn is added to q and not multiplied away.
  Eigen::Quaterniond turn;
  turn.w() = -2 * std::pow(std::sin(angle / 4), 2);
  turn.vec() = half_sinc(angle) * theta;
  const Eigen::Vector4d change = (turn * pose.orientation).coeffs();
  for (int c = 0; c < 4; ++c) store(result, c, pose.component(c) + change[c]);
  normalise(result);
  for (int c = 0; c < 3; ++c) {
    const TwoDouble x = pose.coordinate(c) + dx[c];
    result.position[c] = x.high;
    result.position_low[c] = x.low;
  }
  return result;
}

Pose scaled(const Pose& pose, const TwoDouble& s) {
  Pose result = pose;
  for (int c = 0; c < 3; ++c) {
    const TwoDouble x = pose.coordinate(c) * s;
    result.position[c] = x.high;
    result.position_low[c] = x.low;
  }
  return result;
}

TwoDoubleMatrix rotation_matrix(const Pose& pose) {
  const TwoDouble x = pose.component(0), y = pose.component(1), z = pose.component(2), w = pose.component(3);
  const TwoDouble xx = x * x, yy = y * y, zz = z * z;
  const TwoDouble s = 2.0 / (xx + yy + zz + w * w);
  const TwoDouble sx = s * x, sy = s * y, sz = s * z;
  const TwoDouble xy = sx * y, yz = sy * z, zx = sz * x, wx = sx * w, wy = sy * w, wz = sz * w;
  TwoDoubleMatrix m;
  m.set(0, 0, 1.0 - s * (yy + zz)), m.set(0, 1, xy - wz), m.set(0, 2, zx + wy);
  m.set(1, 0, xy + wz), m.set(1, 1, 1.0 - s * (xx + zz)), m.set(1, 2, yz - wx);
  m.set(2, 0, zx - wy), m.set(2, 1, yz + wx), m.set(2, 2, 1.0 - s * (xx + yy));
  return m;
}

Quad3 widened(const TwoDoubleVector& v) { return {widened(v[0]), widened(v[1]), widened(v[2])}; }

QuadMatrix widened(const TwoDoubleMatrix& m) {
  QuadMatrix result;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) result[r][c] = widened(m(r, c));
  }
  return result;
}

Quad3 quad_position(const Pose& pose) {
  return {widened(pose.coordinate(0)), widened(pose.coordinate(1)), widened(pose.coordinate(2))};
}

QuadMatrix quad_rotation(const Pose& pose) {
  const Quad x = widened(pose.component(0)), y = widened(pose.component(1)), z = widened(pose.component(2)),
             w = widened(pose.component(3));
  const Quad s = 2 / (x * x + y * y + z * z + w * w);
  return {Quad3{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
          Quad3{s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
          Quad3{s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
}

QuadPose widened(const RelativePose& pose) {
  QuadPose result;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) result.rotation[r][c] = pose.rotation(r, c);
    result.displacement[r] = pose.displacement[r];
  }
  return result;
}

RelativePose narrowed(const QuadPose& pose) {
  RelativePose result;
  for (int r = 0; r < 3; ++r) result.rotation.row(r) = rounded(pose.rotation[r]);
  result.displacement = rounded(pose.displacement);
  return result;
}

QuadPose relative_pose(const Pose& a, const Pose& b, const Quad3& displacement) {
  const QuadMatrix to_a = transposed(quad_rotation(a));
  return {to_a * quad_rotation(b), to_a * displacement};
}

Eigen::Quaterniond rotated(const Eigen::Quaterniond& q, const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  Eigen::Quaterniond turn;
  turn.w() = std::cos(angle / 2);
  turn.vec() = half_sinc(angle) * theta;
  return (turn * q).normalized();
}

}  // namespace isojam
