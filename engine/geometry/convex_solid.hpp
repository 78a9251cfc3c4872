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

/// Packings of soft, frictionless convex solids: geometry, energy, equilibria, jamming, and the analysis of jammed
/// packings.
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
  Eigen::Vector3d normal;     ///< n, outward, unit length
  double offset = 0;          ///< n·y for points y of the face, V_p^(1/3)
  std::vector<int> vertices;  ///< vertex indices, counter-clockwise seen from outside
};

/// An edge from tail to head. Face `left` has the edge in this direction in its vertex order; face `right` has it in
/// the opposite direction.
struct Edge {
  int tail = 0, head = 0;   ///< indices of its vertices
  int left = 0, right = 0;  ///< indices of its faces
};

/// An edge in the form that the contact loop needs. The pair of face i of solid A and face j of solid B has the number
/// 32i + j. Where an edge leaves the other solid, one segment of the loop begins and another one ends. The record
/// stores the numbers of both segments' pairs, with 0 for the face that the edge pierces:
struct EdgeRecord {
  std::uint8_t tail, head, left, right;  ///< indices of the edge's vertices and faces
  std::uint8_t tail_at, head_at;         ///< SolidArrays::at() of its vertices
  /// Pair numbers; [0] for an edge of A: 32·left + 2^16·32·right; [1] for an edge of B: right + 2^16·left.
  std::uint32_t pairs[2];
  std::uint64_t faces;  ///< bits of the left and right faces
};

/// Sets of vertices, edges and faces of a solid, as bits. Four words, so that one vector operation joins two sets.
struct alignas(32) Parts {
  /// Bits of vertices, edges and faces; the fourth word is 0.
  std::uint64_t vertices = 0, edges = 0, faces = 0, none = 0;

  /// Joins two sets of parts.
  Parts& operator|=(const Parts& other) {
    vertices |= other.vertices, edges |= other.edges, faces |= other.faces, none |= other.none;
    return *this;
  }
};

/// A solid as flat arrays for the kernels. Vertices and edges are padded with copies of the first one; faces are padded
/// with planes 0·y = far, which have every point on their inner side.
struct SolidArrays {
  static constexpr int max_edges = 64;     ///< limit of edges: one bit each in a 64-bit word
  static constexpr int narrow_edges = 32;  ///< limit up to which one word holds the edges of two solids
  /// Capacity for vertices and for faces. At least three edges end at every vertex and surround every face, so 64 edges
  /// allow 42 of each.
  static constexpr int capacity = 44;
  static constexpr double far = 1e300;  ///< offset of the planes that pad the faces
  /// Vectors of placed solids are stored in blocks of four: x of all four, then y, then z.
  static constexpr int block = 12;  ///< doubles per block
  /// Index of the first double of the k-th vector.
  static constexpr std::uint32_t at(std::uint32_t k) { return block * (k / 4) + k % 4; }

  int vertices = 0, faces = 0, edges = 0;                    ///< numbers of vertices, faces and edges
  alignas(32) double x[capacity], y[capacity], z[capacity];  ///< vertices
  alignas(32) double nx[capacity], ny[capacity], nz[capacity], offset[capacity];  ///< face planes
  /// Low parts: the rounding error of each entry, so that value = entry + low entry to 1e-32.
  alignas(32) double x_low[capacity], y_low[capacity], z_low[capacity];
  /// Low parts of the face planes.
  alignas(32) double nx_low[capacity], ny_low[capacity], nz_low[capacity], offset_low[capacity];
  Edge edge[max_edges];                                       ///< edges by index
  EdgeRecord record[max_edges];                               ///< edges in the form for the kernels
  alignas(32) std::uint8_t tail[max_edges], head[max_edges];  ///< end vertices of the edges
  Parts star[capacity];  ///< per vertex: the vertex, and the edges and faces that meet in it
  /// Heights of the solid's own vertices over its own face planes, [face][vertex]: exactly 0 for the vertices of the
  /// face.
  alignas(32) double height[capacity][capacity];

  /// Vertex v in quadruple precision, low part included.
  Quad3 vertex(int v) const {
    return {widened({x[v], x_low[v]}), widened({y[v], y_low[v]}), widened({z[v], z_low[v]})};
  }
  /// Outward unit normal of face f in quadruple precision.
  Quad3 normal(int f) const {
    return {widened({nx[f], nx_low[f]}), widened({ny[f], ny_low[f]}), widened({nz[f], nz_low[f]})};
  }
  /// Offset n·y of the plane of face f in quadruple precision.
  Quad plane_offset(int f) const { return widened({offset[f], offset_low[f]}); }
};

/// An immutable convex polyhedron, centred on its centroid, with mass density 1. Its volume is 1 (V_p = 1) unless it
/// was constructed with another scale. Lengths are in V_p^(1/3). It has at most 64 edges, hence fewer vertices and
/// faces, so that sets of them are 64-bit masks.
class ConvexSolid {
 public:
  static constexpr int max_features = SolidArrays::max_edges;  ///< limit of vertices, edges and faces

  /// Convex hull of `vertices` (each must be an extreme point), moved and scaled to centroid 0 and unit volume. Throws
  /// NoSolid (hull.hpp), a std::invalid_argument, if a vertex is not extreme or a limit is exceeded.
  ConvexSolid(std::string name, std::span<const Eigen::Vector3d> vertices);
  /// Hull of vertices in quadruple precision, so that every constant is the nearest double and its low part is correct
  /// to 1e-32.
  ConvexSolid(std::string name, std::span<const Quad3> vertices);
  /// `unit`, whose scale is 1, with all lengths multiplied by `scale` > 0.
  ConvexSolid(const ConvexSolid& unit, double scale);

  const std::string& name() const { return name_; }  ///< name in files and messages
  /// The vertices that define the solid, in their original units and position; empty if they were given in quadruple
  /// precision.
  const std::vector<Eigen::Vector3d>& given() const { return given_; }
  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }  ///< relative to the centroid, V_p^(1/3)
  const std::vector<Face>& faces() const { return faces_; }                   ///< faces by index
  const std::vector<Edge>& edges() const { return edges_; }                   ///< edges by index
  const SolidArrays& arrays() const { return arrays_; }                       ///< the same data for the kernels
  double scale() const { return scale_; }  ///< ratio of its lengths to those of the solid of unit volume
  double volume() const { return scale_ * scale_ * scale_; }  ///< volume, and mass
  double inradius() const { return inradius_; }               ///< smallest distance of a face plane from the centroid
  double circumradius() const { return circumradius_; }       ///< largest distance of a vertex from the centroid
  double diameter() const { return diameter_; }               ///< largest distance between two vertices
  /// Radius of gyration about an axis, R = sqrt(I/m), where I is the mean principal moment of inertia and m the mass.
  double gyration_radius() const { return gyration_radius_; }
  /// Length, for the solid of unit volume, below which a contact counts as small and is computed in double-double. It
  /// is the inradius; for a solid with more than narrow_edges edges, which may be flat or blunt everywhere, it is four
  /// circumradii.
  double fine_below() const { return fine_below_; }
  /// Inertia tensor about the centroid, ∫ (|x|² − x xᵀ) dV, body frame; m R² times the identity for a spherical top.
  const Eigen::Matrix3d& inertia() const { return inertia_; }
  /// True if all principal moments of inertia are equal within rounding, as for the Platonic solids and all solids with
  /// their symmetry.
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
