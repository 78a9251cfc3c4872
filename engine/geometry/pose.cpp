#include "engine/geometry/pose.hpp"

#include <cmath>
#include <limits>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

RelativePose relative_pose(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b,
                           const Eigen::Vector3d& displacement) {
  const Eigen::Quaterniond to_a = a.conjugate();
  return {(to_a * b).toRotationMatrix(), to_a * displacement};
}

namespace {

/// sin(|θ|/2)/|θ|.
double half_sinc(double angle) { return sinc(angle / 2) / 2; }

void store(Pose& pose, int c, const DoubleDouble& value) {
  pose.orientation.coeffs()[c] = value.high;
  pose.orientation_low[c] = value.low;
}

DoubleDouble squared_length(const Pose& pose) {
  const DoubleDouble x = pose.component(0), y = pose.component(1), z = pose.component(2), w = pose.component(3);
  return short_sum(short_sum(x * x, y * y), short_sum(z * z, w * w));
}

/// `excess` is |q|² − 1. It is this small if q was normalised in double, and its second order then suffices for 1e-31.
bool is_small(double excess) { return std::abs(excess) <= 4 * std::numeric_limits<double>::epsilon(); }

Pose normalised(const Pose& pose) {
  Pose result = pose;
  const DoubleDouble square = squared_length(pose);
  const double excess = short_sum(square, -1).high;
  if (is_small(excess)) {
    const double correction = excess * (3.0 / 8 * excess - 0.5);
    for (int c = 0; c < 4; ++c) {
      const DoubleDouble q = pose.component(c);
      store(result, c, fast_two_sum(q.high, q.low + q.high * correction));
    }
  } else {
    const DoubleDouble inverse = reciprocal_sqrt(square);
    for (int c = 0; c < 4; ++c) store(result, c, pose.component(c) * inverse);
  }
  return result;
}

/// The pose with its centre at x + dx, rotated by the quaternion 1 + turn. Passing the difference from 1 adds a small
/// rotation to q without loss of digits.
Pose moved(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Quaterniond& rotation) {
  Pose result = pose;
  const Eigen::Vector4d change = (rotation * pose.orientation).coeffs();
  for (int c = 0; c < 4; ++c) store(result, c, short_sum(pose.component(c), change[c]));
  result = normalised(result);
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble x = short_sum(pose.coordinate(c), dx[c]);
    result.position[c] = x.high;
    result.position_low[c] = x.low;
  }
  return result;
}

}  // namespace

bool Pose::operator==(const Pose& other) const {
  return position == other.position && orientation.coeffs() == other.orientation.coeffs() &&
         position_low == other.position_low && orientation_low == other.orientation_low;
}

Pose moved(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  Eigen::Quaterniond rotation;
  rotation.w() = -2 * squared(angle / 4 * sinc(angle / 4));
  rotation.vec() = half_sinc(angle) * theta;
  return moved(pose, dx, rotation);
}

Pose moved_by_half_rotation(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Vector3d& v) {
  const double square = v.squaredNorm();
  Eigen::Quaterniond rotation;
  rotation.w() = -square / (1 + std::sqrt(1 - square));
  rotation.vec() = v;
  return moved(pose, dx, rotation);
}

Pose scaled(const Pose& pose, const DoubleDouble& s) {
  Pose result = pose;
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble x = pose.coordinate(c) * s;
    result.position[c] = x.high;
    result.position_low[c] = x.low;
  }
  return result;
}

DoubleDoubleMatrix operator*(const DoubleDoubleMatrix& a, const DoubleDoubleMatrix& b) {
  DoubleDoubleMatrix product;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) product.set(r, c, a(r, 0) * b(0, c) + a(r, 1) * b(1, c) + a(r, 2) * b(2, c));
  }
  return product;
}

Pose deformed(const Pose& pose, const DoubleDoubleMatrix& f) {
  Pose result = pose;
  for (int r = 0; r < 3; ++r) {
    const DoubleDouble x = f(r, 0) * pose.coordinate(0) + f(r, 1) * pose.coordinate(1) + f(r, 2) * pose.coordinate(2);
    result.position[r] = x.high;
    result.position_low[r] = x.low;
  }
  return result;
}

DoubleDoubleMatrix rotation_matrix(const Pose& pose) {
  const double excess = short_sum(squared_length(pose), -1).high;
  if (!is_small(excess) && std::isfinite(excess)) return rotation_matrix(normalised(pose));
  const DoubleDouble x = pose.component(0), y = pose.component(1), z = pose.component(2), w = pose.component(3);
  const DoubleDouble xx = x * x, yy = y * y, zz = z * z;
  const double correction = excess * excess - excess;
  const auto twice_sum = [&](const DoubleDouble& p, const DoubleDouble& q) {
    const DoubleDouble sum = short_sum(p, q);
    return DoubleDouble{2 * sum.high, 2 * (sum.low + sum.high * correction)};
  };
  const DoubleDouble xy = x * y, yz = y * z, zx = z * x, wx = w * x, wy = w * y, wz = w * z;
  DoubleDoubleMatrix m;
  m.set(0, 0, short_sum(1, -twice_sum(yy, zz))), m.set(0, 1, twice_sum(xy, -wz)), m.set(0, 2, twice_sum(zx, wy));
  m.set(1, 0, twice_sum(xy, wz)), m.set(1, 1, short_sum(1, -twice_sum(xx, zz))), m.set(1, 2, twice_sum(yz, -wx));
  m.set(2, 0, twice_sum(zx, -wy)), m.set(2, 1, twice_sum(yz, wx)), m.set(2, 2, short_sum(1, -twice_sum(xx, yy)));
  return m;
}

Quad3 widened(const DoubleDoubleVector& v) { return {widened(v[0]), widened(v[1]), widened(v[2])}; }

QuadMatrix widened(const DoubleDoubleMatrix& m) {
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

}  // namespace isojam
