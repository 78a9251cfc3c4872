#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/separating_axis.hpp"

namespace isojam {

/// Signed distances of the vertices of one solid from the planes of the other, of[vertex][plane] > 0 outside.
struct Distances {
  alignas(32) double of[SolidArrays::capacity][SolidArrays::capacity];
  std::uint32_t outside[SolidArrays::capacity];    ///< per vertex, planes it lies outside of
  std::uint32_t uncertain[SolidArrays::capacity];  ///< per vertex, planes it lies on to within rounding
};

/// A vertex of the intersection, on an edge of A or of B: weight_tail·tail + weight_head·head. Both weights are
/// products of tabulated distances, so each is right to its own last bits however small it is.
struct Corner {
  Eigen::Vector3d position;  ///< lab frame, from A's centre; from ContactLoop::origin once the loop is closed
  double weight_tail, weight_head;
  std::uint8_t tail, head;  ///< vertices of the edge's own solid
  std::int8_t plane;        ///< face of the other solid that the edge pierces here; −1: the solid's own vertex
  bool of_a;
};

/// An edge of the intersection; corners by index.
struct LoopEdge {
  std::uint8_t from, to;
  std::uint8_t left, right;  ///< faces: i for face i of A, face_of_b + j for face j of B
};

inline constexpr int face_of_b = SolidArrays::capacity;

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
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  int spans = 0, segments = 0;
  std::uint32_t edges_a = 0, edges_b = 0;
  std::array<Corner, max_corners> corner;  ///< of span k: from 2k, to 2k + 1
  std::array<LoopEdge, max_spans> span;
  std::array<LoopEdge, max_corners> segment;
  Distances of_a, of_b;  ///< of the vertices of A from the planes of B, and the other way round
};

/// Finds the loop of A and B, B's centre at r from A's (lab frame). `loop` is overwritten.
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, ContactLoop& loop);
/// Distances smaller than this are taken in two doubles, where a loop is: 2e-3 of the inradius. The rounding of larger
/// ones, gap_tolerance(), is below 1e-11 of themselves.
double refined_below(const ConvexSolid& a, const ConvexSolid& b);
/// The same with small distances taken in two doubles: each is right to its last bits however deep or flat the contact.
/// A and B must have low parts.
void find_contact_loop(const PlacedSolid& a, const PlacedSolid& b, const TwoDoubleVector& r, ContactLoop& loop);

}  // namespace isojam
