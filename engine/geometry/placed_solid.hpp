#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// A solid turned into the lab frame, about its own centre: a view of memory that PlacedSolids owns. Vectors come in
/// blocks of four, x of all four, then y, then z, padded as in SolidArrays; nothing is there twice. 320 bytes
/// (tetrahedron) to 896 (dodecahedron, icosahedron), and as many of low parts that nothing but double-double reads.
class PlacedSolid {
 public:
  static constexpr int block = SolidArrays::block;  ///< doubles of a block of four vectors

  const ConvexSolid& solid() const { return *solid_; }        ///< in its body frame
  int vertices() const { return solid_->arrays().vertices; }  ///< number without padding
  int faces() const { return solid_->arrays().faces; }        ///< number without padding
  /// Body frame → lab frame.
  Eigen::Matrix3d rotation() const { return Eigen::Map<const Eigen::Matrix3d>(rotation_row()); }

  const double* vertex_block(int k) const { return vertices_ + block * k; }  ///< of vertices 4k … 4k + 3
  const double* normal_block(int k) const { return normals_ + block * k; }   ///< of outward unit face normals
  const double* offset() const { return solid_->arrays().offset; }           ///< of the face planes from the centre
  /// Components of one vector, x at [0], y at [4], z at [8].
  const double* vertex_at(int v) const { return vertices_ + at(v); }
  const double* normal_at(int f) const { return normals_ + at(f); }  ///< the same of the normal of face f

  Eigen::Vector3d vertex(int v) const { return vector(vertex_at(v)); }  ///< from the centre, lab frame
  Eigen::Vector3d normal(int f) const { return vector(normal_at(f)); }  ///< of face f, outward, lab frame

  /// Vectors with low parts, of solids placed in double-double only.
  DoubleDoubleVector vertex_double_double(int v) const { return {vertex(v), vector(vertex_at(v) + to_low_)}; }
  /// Outward unit normal of face f.
  DoubleDoubleVector normal_double_double(int f) const { return {normal(f), vector(normal_at(f) + to_low_)}; }
  /// Distance of its plane from the centre.
  DoubleDouble offset_double_double(int f) const { return {offset()[f], solid_->arrays().offset_low[f]}; }
  /// Body frame → lab frame.
  DoubleDoubleMatrix rotation_double_double() const {
    return {rotation(), Eigen::Map<const Eigen::Matrix3d>(rotation_row() + to_low_)};
  }

  /// From a component of a vector to its low part.
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

/// The particles of a packing, placed. Where one is placed anew its views stay good; resize() ends all of them.
class PlacedSolids {
 public:
  /// Makes room for `count` solids, none of them placed, with room for low parts if they are to be placed in
  /// double-double. Keeps a pointer to the solid, which must outlive this.
  void resize(const ConvexSolid& solid, std::size_t count, bool low);
  /// The same for solids of several kinds.
  void resize(std::span<const ConvexSolid* const> solids, bool low);
  std::size_t size() const { return count_; }  ///< number of solids that have room

  /// `rotation`: body frame → lab frame.
  void place(std::size_t k, const Eigen::Matrix3d& rotation);
  /// In double-double: vertices and normals have low parts.
  void place(std::size_t k, const DoubleDoubleMatrix& rotation);

  /// The k-th, which has been placed.
  PlacedSolid operator[](std::size_t k) const {
    if (solid_ == nullptr) return unlike(k);
    const double* at = &lines_[k * stride_].value[0];
    return {*solid_, at, at + to_normals_, to_low_};
  }

 private:
  struct alignas(64) Line {
    double value[8];
  };
  /// Where one of several kinds stands.
  struct Place {
    const ConvexSolid* solid;
    std::size_t line;
  };

  PlacedSolid unlike(std::size_t k) const;
  /// What it is, and where it begins.
  std::pair<const ConvexSolid*, double*> room_of(std::size_t k);

  const ConvexSolid* solid_ = nullptr;  ///< of all of them, if they are alike
  std::size_t count_ = 0;
  std::size_t stride_ = 0;  ///< lines of one solid
  std::ptrdiff_t to_normals_ = 0, to_low_ = 0;
  bool has_low_ = false;
  std::vector<Place> places_;  ///< if there are several kinds
  std::vector<Line> lines_;    ///< of all solids, and after them of the low parts
};

/// A solid placed by itself.
class LonePlacedSolid {
 public:
  /// In doubles.
  LonePlacedSolid(const ConvexSolid& solid, const Eigen::Matrix3d& rotation);
  /// In double-double.
  LonePlacedSolid(const ConvexSolid& solid, const DoubleDoubleMatrix& rotation);

  PlacedSolid view() const { return alone_[0]; }  ///< a view of it, good while this lives
  /// The same.
  operator PlacedSolid() const { return view(); }  // NOLINT(google-explicit-constructor): to be handed to kernels

 private:
  PlacedSolids alone_;
};

}  // namespace isojam
