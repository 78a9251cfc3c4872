#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// A vector whose components are double-doubles.
struct DoubleDoubleVector {
  Eigen::Vector3d high = Eigen::Vector3d::Zero(), low = Eigen::Vector3d::Zero();  ///< nearest doubles; low parts

  DoubleDouble operator[](int c) const { return {high[c], low[c]}; }  ///< component c
  /// Sets component c.
  void set(int c, const DoubleDouble& value) { high[c] = value.high, low[c] = value.low; }
  /// Exact negative.
  DoubleDoubleVector operator-() const { return {-high, -low}; }
};

/// A matrix whose entries are double-doubles.
struct DoubleDoubleMatrix {
  Eigen::Matrix3d high = Eigen::Matrix3d::Identity(), low = Eigen::Matrix3d::Zero();  ///< nearest doubles; low parts

  DoubleDouble operator()(int r, int c) const { return {high(r, c), low(r, c)}; }  ///< entry of row r and column c
  /// Sets the entry of row r and column c.
  void set(int r, int c, const DoubleDouble& value) { high(r, c) = value.high, low(r, c) = value.low; }
};

/// Matrix product; the error of each entry is at most 1e-31 of the largest entry.
DoubleDoubleMatrix operator*(const DoubleDoubleMatrix& a, const DoubleDoubleMatrix& b);

/// Position of the centre (V_p^(1/3)) and orientation (quaternion q, body frame → lab frame) of a particle, each a
/// double-double: x = position + position_low, q = orientation + orientation_low, where the first part is the double
/// nearest to the sum. The rotation is that of q/|q|, for any |q|. If you assign a first part, reset the second one.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< centre, V_p^(1/3), nearest doubles
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< q, nearest doubles
  Eigen::Vector3d position_low = Eigen::Vector3d::Zero();           ///< low part of the centre
  Eigen::Vector4d orientation_low = Eigen::Vector4d::Zero();        ///< x, y, z, w, as in orientation.coeffs()

  bool operator==(const Pose& other) const;

  DoubleDouble coordinate(int c) const { return {position[c], position_low[c]}; }  ///< coordinate c of the centre
  /// Component c of q, as in orientation.coeffs().
  DoubleDouble component(int c) const { return {orientation.coeffs()[c], orientation_low[c]}; }
};

/// The pose after a shift of the centre by dx and a rotation of the orientation to exp(θ)·q, dx and θ in the lab frame.
/// |q| = 1 to 1e-31. Steps far below the spacing of doubles are kept.
Pose moved(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Vector3d& theta);

/// The same with the rotation given by its unit quaternion (√(1 − |v|²), v), v = sin(|θ|/2) θ/|θ|; |v| ≤ 1.
Pose moved_by_half_turn(const Pose& pose, const Eigen::Vector3d& dx, const Eigen::Vector3d& v);

/// The pose with its centre at s·x.
Pose scaled(const Pose& pose, const DoubleDouble& s);

/// The pose with its centre at F x and unchanged orientation.
Pose deformed(const Pose& pose, const DoubleDoubleMatrix& f);

/// Rotation by q/|q|, body frame → lab frame, with an error of at most 1e-31.
DoubleDoubleMatrix rotation_matrix(const Pose& pose);

/// Solid B seen from the body frame of A: a point y in B's body frame is at rotation·y + displacement.
struct RelativePose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< from B's body frame to A's
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< B's centre in A's body frame
};

/// Relative pose of B at `displacement` = x_B − x_A (lab frame, periodic image already chosen).
RelativePose relative_pose(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b,
                           const Eigen::Vector3d& displacement);

/// Relative pose in quadruple precision, see RelativePose.
struct QuadPose {
  QuadMatrix rotation{Quad3{1, 0, 0}, Quad3{0, 1, 0}, Quad3{0, 0, 1}};  ///< B's body frame → A's
  Quad3 displacement{};                                                 ///< B's centre in A's body frame
};

/// Position in quadruple precision, low part included.
Quad3 quad_position(const Pose& pose);
/// Rotation by q/|q|, body frame → lab frame.
QuadMatrix quad_rotation(const Pose& pose);
/// Exact conversion to quadruple precision.
Quad3 widened(const DoubleDoubleVector& v);
QuadMatrix widened(const DoubleDoubleMatrix& m);
QuadPose widened(const RelativePose& pose);
/// Rounds to the nearest doubles.
RelativePose narrowed(const QuadPose& pose);
/// Relative pose of B at `displacement` = x_B − x_A (lab frame, periodic image already chosen).
QuadPose relative_pose(const Pose& a, const Pose& b, const Quad3& displacement);

/// exp(θ)·q, θ a rotation vector in the lab frame (radians); the result is normalised.
Eigen::Quaterniond rotated(const Eigen::Quaterniond& q, const Eigen::Vector3d& theta);

}  // namespace isojam
