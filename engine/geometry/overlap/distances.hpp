#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// The parts of two solids that lie, at least partly, between the supports of both along the line of centres. The
/// intersection lies in this slab, so no other edge reaches it and no other face bounds it. Empty if the solids are
/// separated along that line.
struct Slab {
  Parts of_a, of_b;
};

/// The slab of A and B, with B's centre at r from A's.
Slab slab_between(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r);

/// Signed distances (V_p^(1/3)) of the vertices of one solid from the planes of the other, > 0 outside. A vertex may
/// lack a row if it and all edges that end in it are certainly outside. Columns exist only for planes that can bound
/// the intersection.
struct Distances {
  static constexpr int max_size = SolidArrays::capacity * SolidArrays::capacity;  ///< entries of a table

  int planes = 0;                ///< number of columns, padded to a multiple of 4 with planes that change no result
  const std::uint8_t* face;      ///< face of the other solid, by column
  std::uint64_t rows = 0;        ///< bits of the vertices that have a row
  std::uint64_t candidates = 0;  ///< bits of the edges with an end that is not certainly outside; both ends have rows
  std::uint64_t edges = 0;       ///< bits of the candidates, without those that have both ends outside the same plane
  double nearest = 0;            ///< smallest |distance| in the table
  int least_penetrated = 0;      ///< column of the plane with the smallest penetration by the vertices
  double least_penetration = 0;  ///< that penetration; not positive if the plane separates. Its last bits are a tag
  double* of = nullptr;          ///< the distances, vertices × planes
  std::uint8_t near_face[SolidArrays::capacity];  ///< storage of `face` if it lists only some faces

  static int size(const PlacedSolid& body, const PlacedSolid& other) {
    return body.vertices() * ((other.faces() + 3) / 4 * 4);
  }
  double* row(int v) const { return of + v * planes; }
  int least_penetrated_face() const { return face[least_penetrated]; }
};

/// Fills the table d.of for `body`, with the centre of `other` at `to_other` from its own.
void tabulate_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                        Distances& d);

/// The same for the parts in the slab only, where `body` is the slab's A.
void tabulate_near_distances(const PlacedSolid& body, const PlacedSolid& other, const Eigen::Vector3d& to_other,
                             const Slab& slab, Distances& d);

/// Recomputes everything except the rows and the table, after entries of the table have changed.
void classify(const ConvexSolid& body, Distances& d);

/// Numbers of vertices, of vectors of 4 planes, and of edges; known to the compiler for the Platonic solids.
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

/// Calls function(k) for k < n, unrolled if n is known, so that accumulators stay in registers.
template <int n, class Function>
inline void repeat(std::integral_constant<int, n>, const Function& function) {
  [&]<int... k>(std::integer_sequence<int, k...>) { (function(k), ...); }
  (std::make_integer_sequence<int, n>{});
}
template <class Function>
inline void repeat(int n, const Function& function) {
  for (int k = 0; k < n; ++k) function(k);
}

/// Calls function with the number of vectors, which is known to the compiler if a Platonic solid has that number.
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
