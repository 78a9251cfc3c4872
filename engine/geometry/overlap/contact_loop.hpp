#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/geometry/overlap/distances.hpp"
#include "engine/geometry/overlap/lanes.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Solids with so many edges at most have those of both in one word, as bits, so that the kernel takes them in one
/// loop; others have them in a word each.
inline constexpr int narrow_edges = SolidArrays::narrow_edges, wide_edges = SolidArrays::max_edges;

enum class LoopVerdict : std::uint8_t {
  separated,  ///< a face separates, or no edge of one solid reaches into the other
  closed,     ///< every segment has its two ends: the loop is the boundary between A's part and B's
  degenerate  ///< a vertex lies on a plane to within rounding, the loop does not close, or one solid holds the other
};

/// The edges of the intersection of A and B: parts of edges of either inside the other, and the loop where their
/// surfaces cross. Only what the verdict and the counts say is defined: clearing the rest would cost as much as finding
/// the loop. Face i of A has number i, face j of B face_of_b + j.
struct ContactLoop {
  static constexpr std::uint32_t face_of_b = 64;
  static constexpr int max_spans = 2 * wide_edges;
  static constexpr int max_corners = 2 * max_spans;

  /// Part of an edge, tail → head, from corner 2k to 2k + 1 (k its index).
  struct Span {
    std::uint8_t left, right;  ///< faces, by number
  };
  /// Where face_a (left) crosses face_b (right), counter-clockwise seen from outside A.
  struct Segment {
    std::uint8_t face_b, face_a;  ///< j and i, not face_of_b + j
    std::uint8_t from, to;        ///< corners
  };

  /// An edge that passes through the other solid: 0.. of A, edge_of_b.. of B; the planes where it enters and leaves;
  /// and bits that say whether it does, or begins or ends inside: 0 and 1 for entering, 2 and 3 for leaving.
  struct Crossing {
    std::uint8_t edge, into, out_of, ends;

    std::uint32_t enters() const { return ends & 1U; }
    std::uint32_t leaves() const { return ends >> 3 & 1U; }
  };

  alignas(32) double tables[2 * Distances::max_size];  ///< the memory of of_a and of_b, without a gap
  /// x, y, z from the origin (lab frame), and the height over the reference plane, negative inside:
  /// interpolated between tabulated distances, hence 0 on that plane and never a difference of larger numbers near it.
  alignas(32) double corner[max_corners][4];
  LoopVerdict verdict = LoopVerdict::degenerate;
  SeparatingAxis axis;  ///< the face that separates, if one was found
  Eigen::Vector3d up;   ///< normal of the reference plane: of all face planes the one penetrated least
  int spans = 0, segments = 0;
  std::uint32_t edge_of_b;           ///< narrow_edges or wide_edges, as the loop was found
  std::uint64_t faces[2], edges[2];  ///< of A and of B, those of the intersection
  Distances of_a, of_b;              ///< of the vertices of A from the planes of B, and the other way round
  Eigen::Vector3d origin;            ///< from A's centre: the middle between the centres, if nothing moved it
  std::uint16_t hub[2 * face_of_b];  ///< of each face of the intersection, by number, one of its corners
  Crossing crossing[max_spans + 1];  ///< of the spans
  Span span[max_spans];
  Segment segment[max_corners];
};

/// Finds the loop of A and B, B's centre at r from A's (lab frame). `loop` is overwritten. Neither has more edges than
/// `edges`, narrow_edges or wide_edges; the loop is the same for both, to the last bit.
template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop);
/// Finds the loop with small distances taken in double-double, each right to its last bits however flat the contact. A
/// and B are placed in double-double.
template <int edges>
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, ContactLoop& loop);

}  // namespace isojam
