#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// A vector in double-double: each component is the sum of two doubles.
struct DoubleDoubleVector {
  Eigen::Vector3d high = Eigen::Vector3d::Zero();  ///< nearest doubles of the components
  Eigen::Vector3d low = Eigen::Vector3d::Zero();   ///< remainders of the components

  DoubleDouble operator[](int c) const { return {high[c], low[c]}; }  ///< component c
  /// Sets component c.
  void set(int c, const DoubleDouble& value) { high[c] = value.high, low[c] = value.low; }
  /// The exact negative of the vector.
  DoubleDoubleVector operator-() const { return {-high, -low}; }
};

/// A matrix in double-double: each entry is the sum of two doubles. By default, it is the unit matrix.
struct DoubleDoubleMatrix {
  Eigen::Matrix3d high = Eigen::Matrix3d::Identity();  ///< nearest doubles of the entries
  Eigen::Matrix3d low = Eigen::Matrix3d::Zero();       ///< remainders of the entries

  DoubleDouble operator()(int r, int c) const { return {high(r, c), low(r, c)}; }  ///< entry of row r and column c
  /// Sets the entry of row r and column c.
  void set(int r, int c, const DoubleDouble& value) { high(r, c) = value.high, low(r, c) = value.low; }
};

/// The product of two matrices. The error of each entry is at most 1e-30 × (largest entry of a) × (largest entry of b).
DoubleDoubleMatrix operator*(const DoubleDoubleMatrix& a, const DoubleDoubleMatrix& b);

/// Pose of a particle: the position x of its centre (V_p^(1/3)), and its orientation, a quaternion q that rotates
/// vectors from the body frame to the lab frame. Both are stored as sums of two doubles, of which the first is the
/// double nearest to the sum: x = position + position_low, and q = orientation + orientation_low. q may have any length
/// except 0; the rotation is that of q/|q|. If you assign `position` or `orientation`, also assign the corresponding
/// low part.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< nearest doubles of the centre x, in units of V_p^(1/3)
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< nearest doubles of q
  Eigen::Vector3d position_low = Eigen::Vector3d::Zero();  ///< remainder of the centre x, in units of V_p^(1/3)
  /// remainder of q, in the order x, y, z, w of orientation.coeffs()
  Eigen::Vector4d orientation_low = Eigen::Vector4d::Zero();

  bool operator==(const Pose& other) const;

  DoubleDouble coordinate(int c) const { return {position[c], position_low[c]}; }  ///< coordinate c of the centre
  /// Component c of q, in the order x, y, z, w of orientation.coeffs().
  DoubleDouble component(int c) const { return {orientation.coeffs()[c], orientation_low[c]}; }
};

/// The pose after a motion in which the centre moves by dx and the orientation becomes exp(θ)·q, with dx and θ in the
/// lab frame. The new |q| is 1 with an error of about 1e-31. Even motions of 1e-25 change the pose, in the second
/// double of a number.
Pose moved(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Vector3d& theta);

/// The same motion. v = sin(|θ|/2) θ/|θ| is the vector part of the unit quaternion of the rotation. Its scalar part is
/// √(1 − |v|²). Requires |v| ≤ 1.
Pose moved_by_half_rotation(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Vector3d& v);

/// The pose whose centre x is multiplied by s. The orientation does not change.
Pose scaled(const Pose& pose, const DoubleDouble& s);

/// The pose with its centre at f·x. The orientation does not change.
Pose deformed(const Pose& pose, const DoubleDoubleMatrix& f);

/// Rotation matrix of q/|q| from the body frame to the lab frame, with an error of about 1e-31.
DoubleDoubleMatrix rotation_matrix(const Pose& pose);

/// Pose of solid B relative to solid A. A point y in the body frame of B is at rotation·y + displacement in the body
/// frame of A.
struct RelativePose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< rotation from the body frame of B to the body frame of A
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< B's centre in A's body frame
};

/// Relative pose of B at `displacement` = x_B − x_A (lab frame, periodic image already chosen). a and b, the
/// orientations of A and B, must be unit quaternions.
RelativePose relative_pose(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b,
                           const Eigen::Vector3d& displacement);

/// A RelativePose in quadruple precision.
struct QuadPose {
  /// rotation from the body frame of B to the body frame of A
  QuadMatrix rotation{Quad3{1, 0, 0}, Quad3{0, 1, 0}, Quad3{0, 0, 1}};
  Quad3 displacement{};  ///< B's centre in A's body frame
};

/// The exact position x: the sum of both doubles.
Quad3 quad_position(const Pose& pose);
/// Rotation matrix of q/|q| from the body frame to the lab frame, in quadruple precision. Slower than
/// rotation_matrix().
QuadMatrix quad_rotation(const Pose& pose);
/// Exact conversions to quadruple precision.
Quad3 widened(const DoubleDoubleVector& v);
QuadMatrix widened(const DoubleDoubleMatrix& m);
QuadPose widened(const RelativePose& pose);
/// Rounds to the nearest doubles.
RelativePose narrowed(const QuadPose& pose);
/// Computes relative_pose() in quadruple precision, from both doubles of each orientation. Quaternions may have any
/// length except 0.
QuadPose relative_pose(const Pose& a, const Pose& b, const Quad3& displacement);

}  // namespace isojam
