#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/quad.hpp"
#include "engine/names/enum_names.hpp"

/// Packings of soft, frictionless convex solids: geometry, energy, equilibria, jamming, and what jammed packings are
/// like.
namespace isojam {

/// The Platonic solids.
enum class SolidKind { tetrahedron, cube, octahedron, dodecahedron, icosahedron };
template <>
inline constexpr std::array enum_names<SolidKind>{
    EnumName{SolidKind::tetrahedron, "tetrahedron"}, EnumName{SolidKind::cube, "cube"},
    EnumName{SolidKind::octahedron, "octahedron"}, EnumName{SolidKind::dodecahedron, "dodecahedron"},
    EnumName{SolidKind::icosahedron, "icosahedron"}};

/// The Platonic solids, in the order of tables.
inline constexpr auto all_solids = all_of<SolidKind>;

/// A face: outward unit normal n, n·y = offset on its plane, vertices counter-clockwise seen from outside.
struct Face {
  Eigen::Vector3d normal;     ///< n, outward, of unit length
  double offset = 0;          ///< n·y of its points, V_p^(1/3)
  std::vector<int> vertices;  ///< by number, counter-clockwise seen from outside
};

/// An edge tail → head; `left` is the face that runs along it in this direction, `right` the one that runs back.
struct Edge {
  int tail = 0, head = 0;   ///< its vertices, by number
  int left = 0, right = 0;  ///< its faces, by number
};

/// An edge as the contact loop needs it. A pair of faces (i of a solid A, j of a solid B) is 32i + j here. Where an
/// edge leaves the other solid, one segment of the loop begins and another ends; their pairs, with 0 for the face
/// pierced:
struct EdgeRecord {
  std::uint8_t tail, head, left, right;  ///< vertices and faces of the edge, by number
  std::uint8_t tail_at, head_at;         ///< SolidArrays::at() of its ends
  /// Pairs, [0] as an edge of A: 32·left + 2^16·32·right; [1] as an edge of B: right + 2^16·left.
  std::uint32_t pairs[2];
  std::uint64_t faces;  ///< left and right, as bits
};

/// Parts of a solid, as bits: edges, the vertices at their ends, faces. Four words, so that one operation joins them.
struct alignas(32) Parts {
  /// Bits of vertices, edges and faces; the fourth word is 0.
  std::uint64_t vertices = 0, edges = 0, faces = 0, none = 0;

  /// Joins two sets of parts.
  Parts& operator|=(const Parts& other) {
    vertices |= other.vertices, edges |= other.edges, faces |= other.faces, none |= other.none;
    return *this;
  }
};

/// A solid as flat arrays for the kernels. Vertices and edges are padded with copies of the first, faces with
/// planes 0·y = far that everything lies inside of.
struct SolidArrays {
  static constexpr int max_edges = 64;     ///< limit of edges, one bit each in a word
  static constexpr int narrow_edges = 32;  ///< so many of either of two solids are bits of one word
  /// Of vertices and of faces. Three edges end at every vertex and surround every face: 64 edges allow 42 of each.
  static constexpr int capacity = 44;
  static constexpr double far = 1e300;  ///< offset of planes that pad the faces
  /// Vectors of placed solids come in blocks of four, x of all four, then y, then z. Where the k-th begins:
  static constexpr int block = 12;  ///< doubles
  /// Where the k-th vector begins, in doubles.
  static constexpr std::uint32_t at(std::uint32_t k) { return block * (k / 4) + k % 4; }

  int vertices = 0, faces = 0, edges = 0;                                         ///< numbers without padding
  alignas(32) double x[capacity], y[capacity], z[capacity];                       ///< vertices
  alignas(32) double nx[capacity], ny[capacity], nz[capacity], offset[capacity];  ///< face planes
  /// Low parts, what rounding left of each: value = entry + low entry to 1e-32.
  alignas(32) double x_low[capacity], y_low[capacity], z_low[capacity];
  /// The same of the face planes.
  alignas(32) double nx_low[capacity], ny_low[capacity], nz_low[capacity], offset_low[capacity];
  Edge edge[max_edges];                                       ///< by number
  EdgeRecord record[max_edges];                               ///< of the edges, for the kernels
  alignas(32) std::uint8_t tail[max_edges], head[max_edges];  ///< of the edges
  Parts star[capacity];                                       ///< per vertex: it, and what meets there
  /// Heights of the solid's own vertices over its own face planes, [face][vertex]: exactly 0 for the vertices of the
  /// face.
  alignas(32) double height[capacity][capacity];

  /// Constants in quadruple precision, low parts included.
  Quad3 vertex(int v) const {
    return {widened({x[v], x_low[v]}), widened({y[v], y_low[v]}), widened({z[v], z_low[v]})};
  }
  /// Outward unit normal of face f.
  Quad3 normal(int f) const {
    return {widened({nx[f], nx_low[f]}), widened({ny[f], ny_low[f]}), widened({nz[f], nz_low[f]})};
  }
  /// Its n·y.
  Quad plane_offset(int f) const { return widened({offset[f], offset_low[f]}); }
};

/// An immutable convex polyhedron, centred on its centroid, of density of mass 1, and of unit volume (V_p = 1) unless
/// it was made in another size. Lengths in V_p^(1/3). At most 64 edges, hence fewer vertices and faces, so that sets of
/// them are 64-bit masks.
class ConvexSolid {
 public:
  static constexpr int max_features = SolidArrays::max_edges;  ///< of vertices, edges or faces

  /// Hull of `vertices` (all of them extreme), moved and scaled to unit volume and centroid 0.
  /// Throws NoSolid (hull.hpp), a std::invalid_argument, if a vertex is not extreme or the limits are exceeded.
  ConvexSolid(std::string name, std::span<const Eigen::Vector3d> vertices);
  /// Hull of vertices in quadruple precision, so that every constant is the nearest double and its low part
  /// correct to 1e-32.
  ConvexSolid(std::string name, std::span<const Quad3> vertices);
  /// `unit`, whose scale is 1, with all lengths times `scale` > 0.
  ConvexSolid(const ConvexSolid& unit, double scale);

  const std::string& name() const { return name_; }  ///< what files and messages call it
  /// The vertices that it was made of, in their own units and place; none if these were in quadruple precision.
  const std::vector<Eigen::Vector3d>& given() const { return given_; }
  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }  ///< about the centroid, V_p^(1/3)
  const std::vector<Face>& faces() const { return faces_; }                   ///< by number
  const std::vector<Edge>& edges() const { return edges_; }                   ///< by number
  const SolidArrays& arrays() const { return arrays_; }                       ///< the same for kernels
  double scale() const { return scale_; }                     ///< of its lengths to those of the solid of unit volume
  double volume() const { return scale_ * scale_ * scale_; }  ///< and mass
  double inradius() const { return inradius_; }               ///< least distance of a face from the centroid
  double circumradius() const { return circumradius_; }       ///< greatest distance of a vertex from the centroid
  double diameter() const { return diameter_; }               ///< greatest distance between two vertices
  /// Radius of gyration about an axis, R = sqrt(I/m), I the mean principal moment of inertia, m the mass.
  double gyration_radius() const { return gyration_radius_; }
  /// Of the solid of unit volume, what a contact is small against if double-double is of use: the inradius; of solids
  /// with more than narrow_edges, which may be flat, or blunt everywhere, four circumradii.
  double fine_below() const { return fine_below_; }
  /// Tensor of inertia about the centroid, ∫ (|x|² − x xᵀ) dV, body frame: m R² of a spherical top.
  const Eigen::Matrix3d& inertia() const { return inertia_; }
  /// Whether all moments of inertia are equal, to within rounding: the Platonic solids and all of their symmetry.
  bool is_spherical_top() const { return is_spherical_top_; }

 private:
  std::string name_;
  std::vector<Eigen::Vector3d> given_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  SolidArrays arrays_;
  double scale_ = 1, inradius_ = 0, circumradius_ = 0, fine_below_ = 0, diameter_ = 0, gyration_radius_ = 0;
  Eigen::Matrix3d inertia_ = Eigen::Matrix3d::Zero();
  bool is_spherical_top_ = false;
};

/// The shared immutable instance of a Platonic solid.
const ConvexSolid& platonic(SolidKind kind);

}  // namespace isojam
