#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "engine/geometry/distances.hpp"
#include "engine/geometry/lanes.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/separating_axis.hpp"

namespace isojam {

/// Two placed solids, B's centre at r + r_low = x_B − x_A (lab frame). If both have low parts, plane distances are
/// right to their last bits however flat the contact; if not, r_low is not read.
struct PlacedPair {
  const PlacedSolid* a = nullptr;
  const PlacedSolid* b = nullptr;
  Eigen::Vector3d r = Eigen::Vector3d::Zero(), r_low = Eigen::Vector3d::Zero();

  bool is_precise() const { return a->has_low_parts() && b->has_low_parts(); }
  TwoDoubleVector precise_r() const { return {r, r_low}; }
};

enum class LoopVerdict : std::uint8_t {
  separated,  ///< a face separates, or no edge of one solid reaches into the other
  closed,     ///< every segment has its two ends: the loop is the boundary between A's part and B's
  degenerate  ///< a vertex lies on a plane to within rounding, the loop does not close, or one solid holds the other
};

/// The contact loops of a few pairs at once, each step one loop over all their edges or segments: a pair alone has so
/// few of them that its every loop would end in a mispredicted branch, at a cost beyond that of the arithmetic.
/// A workspace: only what the counts say is defined. Numbers: solid A of pair p is 2p, B 2p + 1; face i of A is 32p +
/// i, face j of B face_of_b + 32p + j.
struct ContactLoops {
  static constexpr int capacity = SolidArrays::capacity;
  static constexpr int max_pairs = 8;
  static constexpr int max_spans = max_pairs * 2 * capacity;
  static constexpr std::uint32_t face_of_b = max_pairs * capacity;

  /// What a solid brings to its pair.
  struct Side {
    const EdgeRecord* edge;
    const PlacedSolid* body;
    const double* distance;        ///< of its vertices from the other's planes,
    const double* height;          ///< and over the reference plane,
    std::uint32_t planes, stride;  ///< with these steps from vertex to vertex
    std::uint32_t reference;       ///< column of the reference plane in `distance`; none if it is the solid's own
    std::uint32_t first_pair;      ///< 1024p, twice: what the pair adds to EdgeRecord::pairs
    Lanes shift;                   ///< the solid's centre; height 0
  };

  /// Part of an edge inside the other solid, from corner 2k to 2k + 1 (k its index), tail → head.
  struct Span {
    std::uint32_t solid, edge;
    std::uint32_t left, right;  ///< faces
  };

  /// Where face i of A (left) crosses face j of B (right), counter-clockwise seen from outside A.
  struct Segment {
    std::uint32_t faces;  ///< 1024p + 32i + j
    std::uint32_t from, to;
  };

  int pairs = 0, spans = 0, segments = 0;
  LoopVerdict verdict[max_pairs];
  SeparatingAxis axis[max_pairs];  ///< of a separated pair: the face that separates, if one was found
  Eigen::Vector3d up[max_pairs];   ///< normal of the reference plane, the one that is penetrated least
  std::uint32_t faces[2 * max_pairs], edges[2 * max_pairs];  ///< of each solid, those of the intersection
  Side side[2 * max_pairs];
  Distances distances[2 * max_pairs];
  alignas(32) double tables[2 * max_pairs * Distances::max_size];  ///< of the distances, without gaps
  /// x, y, z from the middle between the centres (lab frame), and the height over the reference plane, negative inside:
  /// interpolated between tabulated distances, hence 0 on that plane and never a difference of larger numbers near it.
  alignas(32) double corner[2 * max_spans][4];
  std::uint16_t hub[2 * face_of_b];  ///< of each face of an intersection, one of its corners
  Span span[max_spans];
  Segment segment[2 * max_spans];
};

/// Number of the face of B in 1024p + 32i + j.
inline std::uint32_t number_of_b(std::uint32_t faces) {
  constexpr std::uint32_t capacity = SolidArrays::capacity;
  return ContactLoops::face_of_b + faces / (capacity * capacity) * capacity + faces % capacity;
}

/// Finds the loops of at most max_pairs pairs, all of the same two solids.
void find_contact_loops(std::span<const PlacedPair> pairs, ContactLoops& loops);

}  // namespace isojam
