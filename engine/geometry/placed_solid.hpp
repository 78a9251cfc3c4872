#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// A solid rotated into the lab frame, relative to its own centre: a view of memory that PlacedSolids owns. Vectors are
/// stored in blocks of four, x of all four, then y, then z, padded as in SolidArrays. No value is stored twice. A solid
/// takes 320 bytes (tetrahedron) to 896 bytes (dodecahedron, icosahedron). Low parts take as much again; only
/// double-double code reads them.
class PlacedSolid {
 public:
  static constexpr int block = SolidArrays::block;  ///< doubles in a block of four vectors

  const ConvexSolid& solid() const { return *solid_; }        ///< the solid in its body frame
  int vertices() const { return solid_->arrays().vertices; }  ///< number of vertices
  int faces() const { return solid_->arrays().faces; }        ///< number of faces
  /// Rotation from the body frame to the lab frame.
  Eigen::Matrix3d rotation() const { return Eigen::Map<const Eigen::Matrix3d>(rotation_row()); }

  const double* vertex_block(int k) const { return vertices_ + block * k; }  ///< vertices 4k … 4k + 3
  const double* normal_block(int k) const { return normals_ + block * k; }   ///< normals of faces 4k … 4k + 3
  const double* offset() const { return solid_->arrays().offset; }  ///< distances of the face planes from the centre
  /// Components of vertex v: x at [0], y at [4], z at [8].
  const double* vertex_at(int v) const { return vertices_ + at(v); }
  /// Components of the normal of face f, stored in the same way.
  const double* normal_at(int f) const { return normals_ + at(f); }

  Eigen::Vector3d vertex(int v) const { return vector(vertex_at(v)); }  ///< from the centre, lab frame
  Eigen::Vector3d normal(int f) const { return vector(normal_at(f)); }  ///< normal of face f, outward, lab frame

  /// Vertex v with its low part; only for solids placed in double-double.
  DoubleDoubleVector vertex_double_double(int v) const { return {vertex(v), vector(vertex_at(v) + to_low_)}; }
  /// Outward unit normal of face f with its low part.
  DoubleDoubleVector normal_double_double(int f) const { return {normal(f), vector(normal_at(f) + to_low_)}; }
  /// Distance of the plane of face f from the centre.
  DoubleDouble offset_double_double(int f) const { return {offset()[f], solid_->arrays().offset_low[f]}; }
  /// Rotation from the body frame to the lab frame, with its low part.
  DoubleDoubleMatrix rotation_double_double() const {
    return {rotation(), Eigen::Map<const Eigen::Matrix3d>(rotation_row() + to_low_)};
  }

  /// Distance in memory from a component of a vector to its low part, in doubles.
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

/// The placed particles of a packing. Placing a particle again keeps its views valid; resize() invalidates all views.
class PlacedSolids {
 public:
  /// Allocates memory for `count` solids, all still unplaced. `low`: also for low parts, needed to place them in
  /// double-double. Keeps a pointer to the solid, which must outlive this object.
  void resize(const ConvexSolid& solid, std::size_t count, bool low);
  /// Allocates memory for solids of several kinds.
  void resize(std::span<const ConvexSolid* const> solids, bool low);
  std::size_t size() const { return count_; }  ///< number of solids

  /// Places solid k in double; `rotation` is from the body frame to the lab frame.
  void place(std::size_t k, const Eigen::Matrix3d& rotation);
  /// Places solid k in double-double: vertices and normals have low parts.
  void place(std::size_t k, const DoubleDoubleMatrix& rotation);

  /// View of solid k, which must have been placed.
  PlacedSolid operator[](std::size_t k) const {
    if (solid_ == nullptr) return unlike(k);
    const double* at = &lines_[k * stride_].value[0];
    return {*solid_, at, at + to_normals_, to_low_};
  }

 private:
  struct alignas(64) Line {
    double value[8];
  };
  /// Memory of one solid if there are several kinds.
  struct Place {
    const ConvexSolid* solid;
    std::size_t line;
  };

  PlacedSolid unlike(std::size_t k) const;
  /// The solid of particle k, and the beginning of its memory.
  std::pair<const ConvexSolid*, double*> room_of(std::size_t k);

  const ConvexSolid* solid_ = nullptr;  ///< the solid of all particles, if it is the same
  std::size_t count_ = 0;
  std::size_t stride_ = 0;  ///< lines per solid
  std::ptrdiff_t to_normals_ = 0, to_low_ = 0;
  bool has_low_ = false;
  std::vector<Place> places_;  ///< used if there are several kinds
  std::vector<Line> lines_;    ///< all solids, followed by their low parts
};

/// A single placed solid that owns its memory.
class LonePlacedSolid {
 public:
  /// Places the solid in double.
  LonePlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation);
  /// Places the solid in double-double.
  LonePlacedSolid(const ConvexSolid& solid, const DoubleDoubleMatrix& rotation);

  PlacedSolid view() const { return alone_[0]; }  ///< a view, valid during the lifetime of this object
  /// The same view.
  operator PlacedSolid() const { return view(); }  // NOLINT(google-explicit-constructor): to be passed to kernels

 private:
  PlacedSolids alone_;
};

}  // namespace isojam
