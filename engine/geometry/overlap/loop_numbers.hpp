#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/geometry/overlap/contact_loop.hpp"

namespace isojam {

/// Numbers for all possible edges and pairs of faces of two solids with up to `limit` edges.
template <int limit>
struct Numbers {
  using Loop = LoopWith<limit>;
  /// True if one word holds the edges of both solids as bits.
  static constexpr bool in_one_word = 2 * limit <= 64;
  /// Edges of A have numbers below `edges`; those of B follow.
  static constexpr std::uint32_t edges = std::bit_ceil(std::uint32_t{limit});
  /// A pair of faces (i, j) has the number faces·i + j. The number j takes `bits` bits.
  static constexpr std::uint32_t faces = std::min(edges, Loop::face_of_b);
  static constexpr std::uint32_t bits = std::countr_zero(faces);
  static constexpr std::uint32_t all_pairs = faces * faces;
  static constexpr int corners = 4 * limit;

  /// Converts EdgeRecord::pairs, which contain numbers for 32 faces, to numbers for `faces` faces.
  static std::uint32_t pairs(const EdgeRecord& edge, std::uint32_t of_b) {
    return edge.pairs[of_b] << (bits - 5) * (of_b ^ 1);
  }
};

/// A set of edges of two solids, by their numbers.
template <int limit>
class EdgeSet {
 public:
  using Set = typename LoopWith<limit>::Set;

  void add(std::uint32_t edge) {
    if constexpr (in_one_word) {
      set_[0].insert(edge);
    } else {
      set_[edge / Numbers<limit>::edges].insert(edge % Numbers<limit>::edges);
    }
  }
  /// Edges of one solid.
  Set of(int side) const {
    if constexpr (in_one_word) return Set(static_cast<std::uint32_t>(set_[0].word[0] >> limit * side));
    return set_[side];
  }

 private:
  static constexpr bool in_one_word = Numbers<limit>::in_one_word;
  Set set_[in_one_word ? 1 : 2] = {};
};

/// Adds the two faces of the edge.
inline void add_faces(const EdgeRecord& edge, BitSet<1>& faces) { faces.insert_bits(edge.faces, 0); }
template <int words>
void add_faces(const EdgeRecord& edge, BitSet<words>& faces) {
  faces.insert(edge.left), faces.insert(edge.right);
}

}  // namespace isojam
