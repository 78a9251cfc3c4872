#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/geometry/overlap/distances.hpp"
#include "engine/geometry/overlap/lanes.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Limits of edges per solid. Up to narrow_edges, one word holds the edges of both solids as bits, and the kernel
/// handles them in one loop. Up to wide_edges, each solid has a word of its own.
inline constexpr int narrow_edges = SolidArrays::narrow_edges, wide_edges = SolidArrays::max_edges;

enum class LoopVerdict : std::uint8_t {
  separated,  ///< a face separates the solids, or no edge of one solid reaches into the other
  closed,     ///< every segment has two ends: the loop is the boundary between A's part and B's part of the surface
  degenerate  ///< a vertex lies on a plane within rounding, the loop does not close, or one solid contains the other
};

/// Edges of the intersection of A and B: the parts of edges of each solid inside the other, and the loop where their
/// surfaces intersect. Array elements beyond `spans` and `segments` are deliberately uninitialised, because clearing
/// them would cost as much as finding the loop. Face i of A has number i; face j of B has number face_of_b + j.
struct ContactLoop {
  static constexpr std::uint32_t face_of_b = 64;
  static constexpr int max_spans = 2 * wide_edges;
  static constexpr int max_corners = 2 * max_spans;

  /// Part of an edge, oriented from tail to head. The span with index k has the corners 2k and 2k + 1.
  struct Span {
    std::uint8_t left, right;  ///< face numbers
  };
  /// Intersection of face_a (on its left) and face_b (on its right), counter-clockwise seen from outside A.
  struct Segment {
    std::uint8_t face_b, face_a;  ///< j and i, not face_of_b + j
    std::uint8_t from, to;        ///< indices of corners
  };

  /// An edge that passes through the other solid. `edge` is its index for an edge of A, and edge_of_b + index for one
  /// of B. `into` and `out_of` are the planes where it enters and leaves. `ends` states whether it does: bits 0 and 1
  /// are set if it enters, bits 2 and 3 if it leaves. Otherwise the edge begins or ends inside.
  struct Crossing {
    std::uint8_t edge, into, out_of, ends;

    std::uint32_t enters() const { return ends & 1U; }
    std::uint32_t leaves() const { return ends >> 3 & 1U; }
  };

  alignas(32) double tables[2 * Distances::max_size];  ///< contiguous memory of of_a and of_b
  /// Coordinates x, y, z from the origin (lab frame), and the height over the reference plane, negative inside. Heights
  /// are interpolated between tabulated distances. They are hence exactly 0 on the plane, and near it they are never
  /// the difference of larger numbers.
  alignas(32) double corner[max_corners][4];
  LoopVerdict verdict = LoopVerdict::degenerate;
  SeparatingAxis axis;  ///< the separating face, if one was found
  Eigen::Vector3d up;   ///< normal of the reference plane: the face plane with the smallest penetration
  int spans = 0, segments = 0;
  std::uint32_t edge_of_b;           ///< narrow_edges or wide_edges, as chosen for this loop
  std::uint64_t faces[2], edges[2];  ///< bits of the faces and edges of A and of B in the intersection
  Distances of_a, of_b;              ///< vertices of A from the planes of B, and vertices of B from the planes of A
  Eigen::Vector3d origin;  ///< from A's centre: the midpoint of both centres, unless refine_small_corners() moved it
  std::uint16_t hub[2 * face_of_b];  ///< one corner per face of the intersection, by face number
  Crossing crossing[max_spans + 1];  ///< crossings that belong to the spans
  Span span[max_spans];
  Segment segment[max_corners];
};

/// Finds the loop of A and B, with B's centre at r from A's (lab frame). `loop` is overwritten. `edges` is narrow_edges
/// or wide_edges, and neither solid may have more edges. Both give the same loop, bit by bit.
template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop);
/// Finds the loop with small distances computed in double-double, so that each is correct to its last bits even for the
/// flattest contact. A and B must be placed in double-double.
template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, ContactLoop& loop);

}  // namespace isojam
