#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/feature_set.hpp"
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

/// The Platonic solids, in the order in which tables list them.
inline constexpr auto all_solids = all_of<SolidKind>;

/// A face of a polyhedron. For all points y of the face, n·y = offset, where n is the outward unit normal.
struct Face {
  Eigen::Vector3d normal;     ///< outward unit normal n
  double offset = 0;          ///< distance n·y of the plane from the origin, in units of V_p^(1/3)
  std::vector<int> vertices;  ///< indices of the vertices, counter-clockwise seen from outside
};

/// An edge from `tail` to `head`. In the list of vertices of face `left`, `head` follows `tail`. In the list of
/// vertices of face `right`, `tail` follows `head`.
struct Edge {
  int tail = 0, head = 0;   ///< indices of the two vertices
  int left = 0, right = 0;  ///< indices of the two faces
};

/// An edge in the format for the contact loop, in which the surfaces of two solids A and B intersect. Each segment of
/// the loop lies on a face i of A and a face j of B, and this pair of faces has the number 32i + j. Two segments of the
/// loop meet where an edge leaves the other solid. The record stores the numbers of both face pairs, with 0 in place of
/// the face of the other solid, which depends on the poses.
struct EdgeRecord {
  std::uint8_t tail, head, left, right;  ///< indices of the vertices and faces of the edge
  std::uint16_t tail_at, head_at;        ///< SolidArrays::at() of the two vertices
  /// Numbers of the face pairs of both segments. pairs[0] is for an edge of A: 32·left + 2^16·32·right.
  /// pairs[1] is for an edge of B: right + 2^16·left. If a solid of the pair has more than narrow_edges edges,
  /// Numbers::pairs() (overlap/loop_numbers.hpp) replaces the factor 32 by a larger one.
  std::uint32_t pairs[2];
  std::uint64_t faces;  ///< set of the two faces, as bits; 0 if the solid has more than SolidArrays::word_edges edges
};

/// Sets of vertices, edges and faces of a solid. Four sets of one word fit into one vector register, so that one
/// operation computes the union of two Parts.
template <int words>
struct alignas(32) Parts {
  BitSet<words> vertices{};  ///< set of vertices
  BitSet<words> edges{};     ///< set of edges
  BitSet<words> faces{};     ///< set of faces
  BitSet<words> none{};      ///< always empty

  /// Union of both sets.
  Parts& operator|=(const Parts& other) {
    vertices |= other.vertices, edges |= other.edges, faces |= other.faces, none |= other.none;
    return *this;
  }
};

/// A solid as arrays of numbers for the computation of overlaps. The arrays are filled up to a multiple of four
/// elements: those of vertices with copies of the first vertex, and those of faces with planes 0·y = far, which have
/// every point on their inner side.
struct SolidArrays {
  static constexpr int max_edges = 192;  ///< largest number of edges
  /// largest number of vertices, which follows from max_edges, because at least three edges end at every vertex
  static constexpr int max_vertices = 2 * max_edges / 3;
  static constexpr int max_faces = 2 * max_edges / 3;  ///< largest number of faces; every face has at least three edges
  static constexpr int word_edges = 64;  ///< largest number of edges for which a set of edges fits into one 64-bit word
  /// largest number of edges for which the edges of two solids fit into one word
  static constexpr int narrow_edges = 32;
  static constexpr double far = 1e300;  ///< offset of the planes in unused elements
  /// PlacedSolid stores vectors in blocks of four: x of all four vectors, then y, then z.
  static constexpr int block = 12;  ///< number of doubles in a block
  /// Index of the double that contains x of the k-th vector.
  static constexpr std::uint32_t at(std::uint32_t k) { return block * (k / 4) + k % 4; }

  int vertices = 0, faces = 0, edges = 0;  ///< numbers of vertices, faces and edges
  std::vector<double> x, y, z;             ///< vertices
  std::vector<double> nx, ny, nz, offset;  ///< normals and offsets of the face planes
  /// Rounding errors of the entries above: the sum of both is exact to 1e-32.
  std::vector<double> x_low, y_low, z_low;
  std::vector<double> nx_low, ny_low, nz_low, offset_low;  ///< rounding errors of the normals and offsets
  std::vector<EdgeRecord> record;                          ///< edges by index, in the format for the contact loop
  /// Indices of the end vertices of the edges, filled up to a multiple of 16 elements with copies of the first edge.
  std::vector<std::uint8_t> tail, head;
  /// For each vertex: the edges and faces that meet in it, and both ends of each of these edges. Empty for a solid with
  /// more than word_edges edges.
  std::vector<Parts<1>> star;
  /// Height of each vertex above the plane of each face of the same solid, in the order of faces, then of vertices. It
  /// is exactly 0 if the vertex belongs to the face.
  std::vector<double> height;

  /// Heights of all vertices above the plane of face f.
  const double* heights_above(int f) const { return height.data() + f * vertices; }
  /// Vertex v in quadruple precision, with its rounding error added.
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

/// An immutable convex polyhedron with mass density 1, whose centroid is the origin, and whose volume is 1 (V_p = 1)
/// unless it was constructed with another scale. Lengths are in units of V_p^(1/3). It has at most max_edges edges, and
/// therefore at most max_vertices vertices and max_faces faces.
class ConvexSolid {
 public:
  static constexpr int max_edges = SolidArrays::max_edges;        ///< largest number of edges
  static constexpr int max_vertices = SolidArrays::max_vertices;  ///< largest number of vertices
  static constexpr int max_faces = SolidArrays::max_faces;        ///< largest number of faces

  /// Makes the convex hull of `vertices`, moved so that its centroid is the origin and scaled to unit volume. The
  /// vertices are moved by distances of the order of their rounding errors, so that all faces are exactly planar.
  /// Throws NoSolid (hull.hpp), a std::invalid_argument, if a point is not a vertex of the hull, if points coincide or
  /// span no volume, if a face cannot be made planar, or if there are too many features.
  ConvexSolid(std::string name, std::span<const Eigen::Vector3d> vertices);
  /// Makes the convex hull of vertices in quadruple precision. All numbers of the solid are then rounded to the nearest
  /// double, and the stored rounding errors are correct to 1e-32.
  ConvexSolid(std::string name, std::span<const Quad3> vertices);
  /// Makes a copy of `unit` with all lengths multiplied by `scale` > 0. The scale of `unit` must be 1.
  ConvexSolid(const ConvexSolid& unit, double scale);

  const std::string& name() const { return name_; }  ///< name in files and messages
  /// The vertices with which the solid was constructed, in their original units and position. Empty if these vertices
  /// were in quadruple precision.
  const std::vector<Eigen::Vector3d>& given() const { return given_; }
  /// vertices relative to the centroid, in units of V_p^(1/3)
  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<Face>& faces() const { return faces_; }  ///< faces by index
  const std::vector<Edge>& edges() const { return edges_; }  ///< edges by index
  const SolidArrays& arrays() const { return arrays_; }  ///< the same data as arrays for the computation of overlaps
  /// lengths of this solid divided by those of the same solid with unit volume
  double scale() const { return scale_; }
  double volume() const { return scale_ * scale_ * scale_; }  ///< volume, which is also the mass
  double inradius() const { return inradius_; }               ///< smallest distance of a face plane from the centroid
  double circumradius() const { return circumradius_; }       ///< largest distance of a vertex from the centroid
  double diameter() const { return diameter_; }               ///< largest distance between two vertices
  /// Radius of gyration about an axis, R = sqrt(I/m), where I is the mean principal moment of inertia and m the mass.
  double gyration_radius() const { return gyration_radius_; }
  /// Length that sets which parts of an overlap are small enough for double-double (overlap/small_distances.hpp). It is
  /// that of the solid with unit volume: the inradius, or four circumradii for a solid with more than narrow_edges
  /// edges, which may have very flat edges and blunt vertices.
  double fine_below() const { return fine_below_; }
  /// Inertia tensor about the centroid, ∫ (|x|² − x xᵀ) dV, in the body frame. For a spherical top it is m R² times the
  /// identity.
  const Eigen::Matrix3d& inertia() const { return inertia_; }
  /// True if all principal moments of inertia are equal within rounding, as for all solids with the symmetry of a
  /// Platonic solid.
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

/// The immutable object of a Platonic solid, which all users share.
const ConvexSolid& platonic(SolidKind kind);

}  // namespace isojam
