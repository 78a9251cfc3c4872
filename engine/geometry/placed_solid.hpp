#pragma once

#include <Eigen/Core>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// A solid turned into the lab frame, about its own centre: computed once per particle and used by all its pairs.
/// Structure of arrays, each padded to a multiple of 4 as in SolidArrays. About 1 KB, so that a packing of hundreds
/// stays in a core's cache.
class PlacedSolid {
 public:
  PlacedSolid() = default;
  /// Keeps a pointer to the solid, which must outlive this. `rotation`: body frame → lab frame.
  PlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation);

  const ConvexSolid& solid() const { return *solid_; }
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  int vertices() const { return solid_->arrays().vertices; }
  int faces() const { return solid_->arrays().faces; }

  const double* x() const { return pool_; }  ///< vertices
  const double* y() const { return pool_ + vertex_stride_; }
  const double* z() const { return pool_ + 2 * vertex_stride_; }
  const double* nx() const { return pool_ + 3 * vertex_stride_; }  ///< outward unit face normals
  const double* ny() const { return nx() + face_stride_; }
  const double* nz() const { return nx() + 2 * face_stride_; }
  const double* offset() const { return solid_->arrays().offset; }  ///< of the face planes from the centre

  Eigen::Vector3d vertex(int v) const { return {x()[v], y()[v], z()[v]}; }
  Eigen::Vector3d normal(int f) const { return {nx()[f], ny()[f], nz()[f]}; }

 private:
  // Euler: vertices + faces = edges + 2 ≤ capacity + 2, and the padding of both adds at most 6.
  static constexpr int pool_size = 3 * (SolidArrays::capacity + 8);

  alignas(32) double pool_[pool_size];
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  const ConvexSolid* solid_ = nullptr;
  int vertex_stride_ = 0, face_stride_ = 0;
};

}  // namespace isojam
