#pragma once

#include <Eigen/Core>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// A solid turned into the lab frame, about its own centre: computed once per particle and used by all its pairs.
/// Arrays are padded as in SolidArrays. A kernel touches the first rows of each: some 600 (tetrahedron) to 2000 bytes
/// (icosahedron), so that a packing of hundreds stays in a core's cache.
class PlacedSolid {
 public:
  PlacedSolid() = default;
  /// Keeps a pointer to the solid, which must outlive this. `rotation`: body frame → lab frame.
  PlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation);
  /// Places the solid in double-double: vertices and normals have low parts.
  PlacedSolid(const ConvexSolid& solid, const DoubleDoubleMatrix& rotation);

  const ConvexSolid& solid() const { return *solid_; }
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  int vertices() const { return solid_->arrays().vertices; }
  int faces() const { return solid_->arrays().faces; }

  const double* x() const { return x_; }  ///< vertices
  const double* y() const { return y_; }
  const double* z() const { return z_; }
  const double* row(int v) const { return rows_[v]; }                ///< (x, y, z, 0) of a vertex
  const double* normal_row(int f) const { return normal_rows_[f]; }  ///< (x, y, z, 0) of a normal
  const double* nx() const { return normals_[0]; }                   ///< outward unit face normals
  const double* ny() const { return normals_[1]; }
  const double* nz() const { return normals_[2]; }
  const double* offset() const { return solid_->arrays().offset; }  ///< of the face planes from the centre

  Eigen::Vector3d vertex(int v) const { return {x_[v], y_[v], z_[v]}; }
  Eigen::Vector3d normal(int f) const { return {nx()[f], ny()[f], nz()[f]}; }

  /// Vectors with low parts, of solids placed in double-double only.
  DoubleDoubleVector vertex_double_double(int v) const { return {vertex(v), {x_low_[v], y_low_[v], z_low_[v]}}; }
  DoubleDoubleVector normal_double_double(int f) const { return {normal(f), {nx_low_[f], ny_low_[f], nz_low_[f]}}; }
  DoubleDouble offset_double_double(int f) const { return {offset()[f], solid_->arrays().offset_low[f]}; }
  DoubleDoubleMatrix rotation_double_double() const { return {rotation_, rotation_low_}; }

 private:
  static constexpr int capacity = SolidArrays::capacity;

  void copy_rows();

  const ConvexSolid* solid_ = nullptr;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity(), rotation_low_ = Eigen::Matrix3d::Zero();
  alignas(32) double rows_[capacity][4], normal_rows_[capacity][4];
  alignas(32) double normals_[3][capacity];
  alignas(32) double x_[capacity], y_[capacity], z_[capacity];
  alignas(32) double nx_low_[capacity], ny_low_[capacity], nz_low_[capacity];
  alignas(32) double x_low_[capacity], y_low_[capacity], z_low_[capacity];
};

}  // namespace isojam
