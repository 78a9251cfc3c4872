#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// A placed solid: the vertices and face normals of a particle, rotated into the lab frame, relative to the centre of
/// the particle. The object is a view of memory that PlacedSolids owns. Vectors are stored in blocks of four: x of all
/// four vectors, then y, then z; unused elements are filled as in SolidArrays. A placed Platonic solid takes 320 bytes
/// (tetrahedron) to 896 bytes (dodecahedron, icosahedron). In double-double, the rounding errors (low parts) of all
/// values take the same amount of memory again.
class PlacedSolid {
 public:
  static constexpr int block = SolidArrays::block;  ///< number of doubles in a block of four vectors

  const ConvexSolid& solid() const { return *solid_; }        ///< the solid in its body frame
  int vertices() const { return solid_->arrays().vertices; }  ///< number of vertices
  int faces() const { return solid_->arrays().faces; }        ///< number of faces
  /// Rotation from the body frame to the lab frame.
  Eigen::Matrix3d rotation() const { return Eigen::Map<const Eigen::Matrix3d>(rotation_row()); }

  const double* vertex_block(int k) const { return vertices_ + block * k; }  ///< vertices 4k … 4k + 3
  const double* normal_block(int k) const { return normals_ + block * k; }   ///< normals of faces 4k … 4k + 3
  /// distances of the face planes from the centre, in units of V_p^(1/3)
  const double* offset() const { return solid_->arrays().offset.data(); }
  /// Pointer to the components of vertex v: x at [0], y at [4], z at [8].
  const double* vertex_at(int v) const { return vertices_ + at(v); }
  /// Pointer to the components of the normal of face f: x at [0], y at [4], z at [8].
  const double* normal_at(int f) const { return normals_ + at(f); }

  Eigen::Vector3d vertex(int v) const { return vector(vertex_at(v)); }  ///< vertex v relative to the centre, lab frame
  Eigen::Vector3d normal(int f) const { return vector(normal_at(f)); }  ///< outward unit normal of face f, lab frame

  /// Vertex v in double-double. The solid must have been placed in double-double.
  DoubleDoubleVector vertex_double_double(int v) const { return {vertex(v), vector(vertex_at(v) + to_low_)}; }
  /// Outward unit normal of face f in double-double. The solid must have been placed in double-double.
  DoubleDoubleVector normal_double_double(int f) const { return {normal(f), vector(normal_at(f) + to_low_)}; }
  /// Distance of the plane of face f from the centre, in double-double.
  DoubleDouble offset_double_double(int f) const { return {offset()[f], solid_->arrays().offset_low[f]}; }
  /// Rotation from the body frame to the lab frame, in double-double. The solid must have been placed in double-double.
  DoubleDoubleMatrix rotation_double_double() const {
    return {rotation(), Eigen::Map<const Eigen::Matrix3d>(rotation_row() + to_low_)};
  }

  /// Distance in memory, in doubles, from a component of a vector to the rounding error of this component.
  std::ptrdiff_t to_low() const { return to_low_; }

 private:
  friend class PlacedSolids;
  PlacedSolid(const ConvexSolid& solid, const double* vertices, const double* normals, std::ptrdiff_t to_low)
      : solid_(&solid), vertices_(vertices), normals_(normals), to_low_(to_low) {}
  const double* rotation_row() const { return normals_ + block * blocks(faces()); }

  static int blocks(int n) { return (n + 3) / 4; }
  static std::size_t at(int k) { return SolidArrays::at(static_cast<std::uint32_t>(k)); }
  static Eigen::Vector3d vector(const double* p) { return {p[0], p[4], p[8]}; }

  const ConvexSolid* solid_;
  const double *vertices_, *normals_;
  std::ptrdiff_t to_low_;
};

/// The placed solids of all particles of a packing. If a particle is placed again, its views stay valid and have the
/// new values, while resize() invalidates all views.
class PlacedSolids {
 public:
  /// Allocates memory for `count` copies of a solid, and places none of them. Set `low` to true if they will be placed
  /// in double-double, which needs more memory. The solid must outlive this object.
  void resize(const ConvexSolid& solid, std::size_t count, bool low);
  /// Allocates memory for particles with several different solids, in the same way.
  void resize(std::span<const ConvexSolid* const> solids, bool low);
  std::size_t size() const { return count_; }  ///< number of solids

  /// Places solid k in double precision. `rotation` rotates the body frame into the lab frame.
  void place(std::size_t k, const Eigen::Matrix3d& rotation);
  /// Places solid k in double-double.
  void place(std::size_t k, const DoubleDoubleMatrix& rotation);

  /// The placed solid k. It must have been placed before.
  PlacedSolid operator[](std::size_t k) const {
    if (solid_ == nullptr) return unlike(k);
    const double* at = &lines_[k * stride_].value[0];
    return {*solid_, at, at + to_normals_, to_low_};
  }

 private:
  struct alignas(64) Line {
    double value[8];
  };
  /// Memory of one particle, used if there are several different solids.
  struct Place {
    const ConvexSolid* solid;
    std::size_t line;
  };

  PlacedSolid unlike(std::size_t k) const;
  /// The solid of particle k, and a pointer to its memory.
  std::pair<const ConvexSolid*, double*> room_of(std::size_t k);

  const ConvexSolid* solid_ = nullptr;  ///< the solid, if all particles have the same one; otherwise null
  std::size_t count_ = 0;
  std::size_t stride_ = 0;  ///< number of lines per solid
  std::ptrdiff_t to_normals_ = 0, to_low_ = 0;
  bool has_low_ = false;
  std::vector<Place> places_;  ///< used if there are several different solids
  std::vector<Line> lines_;    ///< values of all solids, followed by the rounding errors of all solids
};

/// A placed solid that owns its memory.
class LonePlacedSolid {
 public:
  /// Places the solid in double precision.
  LonePlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation);
  /// Places the solid in double-double.
  LonePlacedSolid(const ConvexSolid& solid, const DoubleDoubleMatrix& rotation);

  PlacedSolid view() const { return alone_[0]; }  ///< a view, which is valid during the lifetime of this object
  /// Converts to the same view.
  operator PlacedSolid() const { return view(); }  // NOLINT(google-explicit-constructor): to be passed to kernels

 private:
  PlacedSolids alone_;
};

}  // namespace isojam
