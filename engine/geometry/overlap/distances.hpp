#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Limits of the solids for which the functions of this folder are compiled. The sets of features of small solids fit
/// into one word.
struct SmallSolids {
  static constexpr int edges = SolidArrays::word_edges;  ///< largest number of edges
  static constexpr int words = 1;                        ///< number of 64-bit words of a set of features
  /// largest number of vertices and of faces, as a multiple of 4: 64 edges join at most 42 faces, and have at most 42
  /// ends.
  static constexpr int capacity = 44;
  static constexpr std::uint64_t tags = 64;  ///< range of the indices of planes in tagged numbers, see lanes.hpp
  using Index = std::uint8_t;                ///< numbers of the edges, faces and corners of both solids
};
/// The limits of all solids.
struct LargeSolids {
  static constexpr int edges = SolidArrays::max_edges;
  static constexpr int words = 3;
  static constexpr int capacity = SolidArrays::max_faces;
  static constexpr std::uint64_t tags = 128;
  using Index = std::uint16_t;
};
static_assert(LargeSolids::capacity % 4 == 0 && SolidArrays::max_vertices <= LargeSolids::capacity);

/// The slab between two planes perpendicular to the line of centres. One plane contains the vertex of A that is
/// farthest in the direction of B. The other one contains the vertex of B that is farthest in the direction of A. The
/// intersection lies in the slab. `of_a` and `of_b` are the vertices, edges and faces that are at least partly in the
/// slab; no other features belong to the intersection. Both are empty if the solids are separated along the line of
/// centres.
template <class Solids>
struct Slab {
  Parts<Solids::words> of_a, of_b;
};

/// The slab of A and B, where r = x_B − x_A.
template <class Solids>
Slab<Solids> slab_between(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r);

/// Table of the signed distances (V_p^(1/3)) of the vertices of one solid from the face planes of the other solid,
/// positive outside. A vertex may have no row if the vertex and all its edges are certainly outside. A plane has a
/// column only if it can bound the intersection.
template <class Solids>
struct Distances {
  using Set = BitSet<Solids::words>;
  /// largest number of entries of a table
  static constexpr int max_size = Solids::capacity * Solids::capacity;

  int planes = 0;  ///< number of columns, a multiple of 4; unused columns are planes that do not change the result
  const std::uint8_t* face;  ///< index of the face of the other solid, for each column
  Set rows{};                ///< set of the vertices that have a row
  Set candidates{};    ///< set of the edges of which at least one end is not certainly outside; both ends have rows
  Set edges{};         ///< set of the candidates, without the edges whose two ends are outside of the same plane
  double nearest = 0;  ///< smallest absolute value of a distance in the table
  int least_penetrated = 0;  ///< column of the plane with the smallest penetration
  /// penetration of this plane by the vertices; not positive if the plane separates the solids. Its last bits are an
  /// index, see lanes.hpp
  double least_penetration = 0;
  double* of = nullptr;  ///< the distances, as a matrix of vertices × planes
  /// memory for `face` if the table has columns for only some of the faces
  std::uint8_t near_face[Solids::capacity];

  static int size(const PlacedSolid& body, const PlacedSolid& other) {
    return body.vertices() * ((other.faces() + 3) / 4 * 4);
  }
  double* row(int v) const { return of + v * planes; }
  int least_penetrated_face() const { return face[least_penetrated]; }
};

/// Computes all distances d.of of the vertices of `body` from the planes of `other`. `to_other` is the centre of
/// `other` relative to the centre of `body`.
template <class Solids>
void tabulate_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                        Distances<Solids>& d);

/// Computes only the distances for features in the slab, which must not be empty. `body` must be the solid A of the
/// slab.
template <class Solids>
void tabulate_near_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                             const Slab<Solids>& slab, Distances<Solids>& d);

/// Recomputes all members except the rows and the table, after entries of the table have changed.
template <class Solids>
void classify(const ConvexSolid& body, Distances<Solids>& d);

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

template <class Solids, class Function>
inline void with_counts(const SolidArrays& body, int planes, const Function& function) {
  const int vectors = (planes + 3) / 4;
  if constexpr (Solids::words == 1) {  // a pair of Platonic solids is never large
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

/// Calls `function` with the number of vectors of 4 planes. The argument is a compile-time constant if the faces of a
/// Platonic solid need this number of vectors.
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
