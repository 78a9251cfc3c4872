#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "engine/arithmetic/lanes.hpp"
#include "engine/geometry/overlap/distances.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Limits of the number of edges of a solid. Up to narrow_edges, the edges of both solids are bits of one 64-bit word,
/// and one loop processes all of them. Up to wide_edges, each solid has a separate word. Up to large_edges, each solid
/// has several words.
inline constexpr int narrow_edges = SolidArrays::narrow_edges, wide_edges = SmallSolids::edges,
                     large_edges = LargeSolids::edges;

enum class LoopVerdict : std::uint8_t {
  separated,  ///< a face separates the solids, or no edge of A or B has a point inside the other solid
  /// both ends of every segment were found. The loop is then the boundary between the two parts of the surface of the
  /// intersection that belong to A and to B
  closed,
  /// a vertex lies on a plane within rounding errors, the loop is not closed, or one solid contains the other
  degenerate
};

/// Edges of the intersection of A and B. These are the parts of the edges of each solid that are inside the other
/// solid, called spans, and the segments of the loop in which the two surfaces intersect. Array elements beyond `spans`
/// and `segments` are not initialised, because this would cost as much time as finding the loop. Face i of A has the
/// number i; face j of B has the number face_of_b + j.
template <class Solids>
struct ContactLoop {
  using Index = typename Solids::Index;
  using Set = BitSet<Solids::words>;
  static constexpr std::uint64_t tags = Solids::tags;
  static constexpr std::uint32_t face_of_b = std::bit_ceil(std::uint32_t{Solids::capacity});
  static constexpr int max_spans = 2 * Solids::edges;
  static constexpr int max_corners = 2 * max_spans;

  /// Part of an edge, oriented from tail to head. The span with index k joins the corners 2k and 2k + 1.
  struct Span {
    std::uint8_t left, right;  ///< numbers of the faces to the left and right of the edge
  };
  /// Part of the line in which face_a and face_b intersect, with face_a on its left and face_b on its right. Segments
  /// are oriented counter-clockwise, seen from outside A.
  struct Segment {
    Index face_b, face_a;  ///< indices j of the face of B and i of the face of A; face_of_b is not added
    Index from, to;        ///< indices of corners
  };

  /// An edge with a part inside the other solid. `edge` is the index of an edge of A, or edge_of_b + the index of an
  /// edge of B. `into` is the plane through which the edge enters the other solid, and `out_of` the plane through which
  /// it leaves. Bits 0 and 1 of `ends` are set if the edge enters, bits 2 and 3 if it leaves. If they are not set, the
  /// edge begins or ends inside the other solid.
  struct Crossing {
    Index edge, into, out_of, ends;

    std::uint32_t enters() const { return ends & 1U; }
    std::uint32_t leaves() const { return ends >> 3 & 1U; }
  };

  alignas(32) double tables[2 * Distances<Solids>::max_size];  ///< memory of the tables of_a and of_b
  /// For each corner, the coordinates x, y, z relative to `origin` (lab frame), and the height above the reference
  /// plane, which is negative inside. Heights are interpolated between the distances in the tables. They are therefore
  /// exactly 0 on the plane. Near the plane they are never computed as the difference of larger numbers. After
  /// refine_small_corners(), heights are relative to one of the corners instead.
  alignas(32) double corner[max_corners][4];
  LoopVerdict verdict = LoopVerdict::degenerate;
  SeparatingAxis axis;  ///< the face that separates the solids, if one was found
  Eigen::Vector3d up;   ///< normal of the reference plane, which is the face plane with the smallest penetration
  int spans = 0, segments = 0;
  std::uint32_t edge_of_b;  ///< a power of two, which depends on the limit of edges chosen for this loop
  Set faces[2], edges[2];   ///< sets of the faces and edges of A and of B in the intersection
  /// distances of the vertices of A from the planes of B, and of the vertices of B from the planes of A
  Distances<Solids> of_a, of_b;
  /// origin of the corners, relative to the centre of A; it is the midpoint of both centres, unless
  /// refine_small_corners() moved it
  Eigen::Vector3d origin;
  std::uint16_t hub[2 * face_of_b];  ///< one corner of each face of the intersection, by the number of the face
  Crossing crossing[max_spans + 1];  ///< the edge of each span
  Span span[max_spans];
  Segment segment[max_corners];
};

/// The loop of solids with up to this number of edges.
template <int edges>
using LoopWith = ContactLoop<std::conditional_t<(edges <= SmallSolids::edges), SmallSolids, LargeSolids>>;

/// Finds the loop of A and B, where r = x_B − x_A (lab frame). `loop` is overwritten. `edges` must be narrow_edges,
/// wide_edges or large_edges, and no solid may have more edges. Narrow and wide loops are the same, bit by bit. The
/// corners of a large loop have the same positions too, unless two planes intersect an edge at points less than 128 ulp
/// apart.
template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, LoopWith<edges>& loop);
/// Finds the loop in the same way, but computes small distances in double-double. They are then correct to their last
/// bits even for very flat contacts. A and B must have been placed in double-double.
template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, LoopWith<edges>& loop);

}  // namespace isojam
