#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/geometry/distances.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/separating_axis.hpp"

namespace isojam {

/// Face i of A has number i in the intersection, face j of B number face_of_b + j.
inline constexpr int face_of_b = SolidArrays::capacity;

/// A segment of the loop; corners by index, faces by number.
struct LoopSegment {
  std::uint16_t from, to;
  std::uint16_t face_a, face_b;
};

enum class LoopVerdict : std::uint8_t {
  separated,  ///< no intersection, beyond the reach of rounding
  closed,     ///< every segment has its two ends: the loop is the boundary between A's part and B's
  degenerate  ///< a vertex lies on a plane to within rounding, a loop does not close, or one solid holds the other
};

/// The edges of the intersection of A and B: `span`, parts of edges of A or B inside the other, tail → head; `segment`,
/// where face i of A (left) crosses face j of B (right), counter-clockwise seen from outside A. Entries beyond the
/// counts are left as they were, since clearing them would cost as much as finding the loop.
struct ContactLoop {
  static constexpr int max_spans = 2 * SolidArrays::capacity;
  static constexpr int max_corners = 2 * max_spans;

  LoopVerdict verdict = LoopVerdict::degenerate;
  SeparatingAxis axis;  ///< the face that separates, if one does
  int reference = 0;    ///< the face whose plane heights are measured from, by number
  int spans = 0, segments = 0;
  std::uint32_t edges_a = 0, edges_b = 0;
  /// x, y, z from A's centre (lab frame), and the height over the reference plane (negative inside), interpolated
  /// between tabulated distances: 0 on that plane, and never the difference of larger numbers near it.
  /// Of span k: from 2k, to 2k + 1.
  alignas(32) double corner[max_corners][4];
  std::uint16_t span[max_spans];  ///< numbers of the faces to the left and right of the edge: left + 256·right
  LoopSegment segment[max_corners];
  Distances of_a, of_b;  ///< of the vertices of A from the planes of B, and the other way round
};

/// Finds the loop of A and B, B's centre at r from A's (lab frame). `loop` is overwritten.
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop);

}  // namespace isojam
