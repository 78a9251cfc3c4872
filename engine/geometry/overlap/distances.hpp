#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// The slab between two planes perpendicular to the line of centres: the plane through the vertex of A that is farthest
/// in the direction of B, and the plane through the vertex of B that is farthest in the direction of A. The
/// intersection lies in the slab. `of_a` and `of_b` are the vertices, edges and faces that are at least partly in the
/// slab; no other features belong to the intersection. Empty if the solids are separated along the line of centres.
struct Slab {
  Parts of_a, of_b;
};

/// The slab of A and B, where r = x_B − x_A.
Slab slab_between(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r);

/// Table of the signed distances (V_p^(1/3)) of the vertices of one solid from the face planes of the other solid,
/// positive outside. A vertex may have no row if the vertex and all its edges are certainly outside. A plane has a
/// column only if it can bound the intersection.
struct Distances {
  /// largest number of entries of a table
  static constexpr int max_size = SolidArrays::capacity * SolidArrays::capacity;

  int planes = 0;  ///< number of columns, a multiple of 4; unused columns are planes that do not change the result
  const std::uint8_t* face;  ///< index of the face of the other solid, for each column
  std::uint64_t rows = 0;    ///< set of the vertices that have a row, as bits
  /// set of the edges of which at least one end is not certainly outside; both ends have rows
  std::uint64_t candidates = 0;
  std::uint64_t edges = 0;   ///< set of the candidates, without the edges whose two ends are outside of the same plane
  double nearest = 0;        ///< smallest absolute value of a distance in the table
  int least_penetrated = 0;  ///< column of the plane with the smallest penetration
  /// penetration of this plane by the vertices; not positive if the plane separates the solids. Its last bits are an
  /// index, see lanes.hpp
  double least_penetration = 0;
  double* of = nullptr;  ///< the distances, as a matrix of vertices × planes
  /// memory for `face` if the table has columns for only some of the faces
  std::uint8_t near_face[SolidArrays::capacity];

  static int size(const PlacedSolid& body, const PlacedSolid& other) {
    return body.vertices() * ((other.faces() + 3) / 4 * 4);
  }
  double* row(int v) const { return of + v * planes; }
  int least_penetrated_face() const { return face[least_penetrated]; }
};

/// Computes all distances d.of of the vertices of `body` from the planes of `other`. `to_other` is the centre of
/// `other` relative to the centre of `body`.
void tabulate_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                        Distances& d);

/// Computes only the distances for features in the slab. `body` must be the solid A of the slab.
void tabulate_near_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                             const Slab& slab, Distances& d);

/// Recomputes all members except the rows and the table, after entries of the table have changed.
void classify(const ConvexSolid& body, Distances& d);

/// Numbers of vertices, of vectors of 4 planes, and of edges. For the Platonic solids they are compile-time constants.
template <int v, int p, int e>
struct Counts {
  static constexpr std::integral_constant<int, v> vertices{};
  static constexpr std::integral_constant<int, p> vectors{};
  static constexpr std::integral_constant<int, e> edges{};
};
struct AnyCounts {
  int vertices, vectors, edges;
};

template <class Function>
inline void with_counts(const SolidArrays& body, int planes, const Function& function) {
  const int vectors = (planes + 3) / 4;
  switch (64 * body.vertices + vectors) {
    case 64 * 4 + 1: return function(Counts<4, 1, 6>{});
    // Other solids may have the same number of vertices, but another number of edges.
    case 64 * 8 + 2:
      if (body.edges == 12) return function(Counts<8, 2, 12>{});
      break;
    case 64 * 6 + 2:
      if (body.edges == 12) return function(Counts<6, 2, 12>{});
      break;
    case 64 * 20 + 3:
      if (body.edges == 30) return function(Counts<20, 3, 30>{});
      break;
    case 64 * 12 + 5:
      if (body.edges == 30) return function(Counts<12, 5, 30>{});
      break;
    default: break;
  }
  function(AnyCounts{body.vertices, vectors, body.edges});
}

/// Calls function(k) for every k < n. If n is a compile-time constant, the loop is unrolled, so that sums stay in
/// registers.
template <int n, class Function>
inline void repeat(std::integral_constant<int, n>, const Function& function) {
  [&]<int... k>(std::integer_sequence<int, k...>) { (function(k), ...); }
  (std::make_integer_sequence<int, n>{});
}
template <class Function>
inline void repeat(int n, const Function& function) {
  for (int k = 0; k < n; ++k) function(k);
}

/// Calls `function` with the number of vectors. The number is a compile-time constant if a Platonic solid has this
/// number.
template <class Function>
void with_vectors(int vectors, const Function& function) {
  switch (vectors) {
    case 1: return function(std::integral_constant<int, 1>{});
    case 2: return function(std::integral_constant<int, 2>{});
    case 3: return function(std::integral_constant<int, 3>{});
    case 5: return function(std::integral_constant<int, 5>{});
    default: return function(vectors);
  }
}

}  // namespace isojam
