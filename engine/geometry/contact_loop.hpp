#pragma once

#include <array>
#include <cstdint>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/geometry/separating_axis.hpp"

namespace isojam {

/// Part of an edge of one solid inside the other, tail → head of the edge.
struct EdgeSpan {
  Eigen::Vector3d from, to;
  std::uint8_t left, right;  ///< faces of the edge's own solid
  bool of_a;
};

/// A segment of the loop where face i of A crosses face j of B, counter-clockwise seen from outside A.
struct LoopSegment {
  Eigen::Vector3d from, to;
  std::uint8_t face_a, face_b;
};

/// A solid's vertices and planes in the frame of A.
struct PlacedSolid {
  alignas(32) double x[SolidArrays::capacity], y[SolidArrays::capacity], z[SolidArrays::capacity];
  alignas(32) double nx[SolidArrays::capacity], ny[SolidArrays::capacity], nz[SolidArrays::capacity],
      offset[SolidArrays::capacity];

  Eigen::Vector3d normal(int f) const { return {nx[f], ny[f], nz[f]}; }
  Eigen::Vector3d vertex(int v) const { return {x[v], y[v], z[v]}; }
};

enum class LoopVerdict : std::uint8_t {
  separated,  ///< no intersection, beyond the reach of rounding
  closed,     ///< every segment has its two ends: the loop is the boundary between A's part and B's
  degenerate  ///< a vertex lies on a plane to within rounding, a loop does not close, or one solid holds the other
};

/// The edges of the intersection of A and B (the first `spans` and `segments` entries; the others are left as they
/// were, since clearing them would cost as much as finding the loop), relative to `origin` (a vertex of the
/// intersection) in A's frame.
struct ContactLoop {
  static constexpr int max_spans = 2 * SolidArrays::capacity;
  static constexpr int max_segments = 2 * max_spans;

  LoopVerdict verdict = LoopVerdict::degenerate;
  SeparatingAxis axis;  ///< the face that separates, if one does
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  int spans = 0, segments = 0;
  std::uint32_t edges_a = 0, edges_b = 0;
  std::array<EdgeSpan, max_spans> span;
  std::array<LoopSegment, max_segments> segment;
  PlacedSolid b;  ///< B in A's frame
};

/// Finds the loop. `loop` is overwritten.
void find_contact_loop(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, ContactLoop& loop);

}  // namespace isojam
