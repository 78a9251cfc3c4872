#pragma once

#include <bit>
#include <cstdint>

namespace isojam {

/// A set of vertices, edges or faces of a solid: bit k % 64 of word k / 64 is set if the feature with index k belongs
/// to the set. BitSet{} is the empty set. A BitSet without initialiser has no defined content: an initialisation would
/// cost too much for an array of sets in the computation of an overlap.
template <int words>
struct BitSet {
  std::uint64_t word[words];  ///< the bits

  BitSet() = default;
  /// The set with the bits of one word.
  BitSet(std::uint64_t bits) : word{bits} {}  // NOLINT(google-explicit-constructor): a word is a set
  /// The same set in more words.
  template <int fewer>
  // NOLINTNEXTLINE(google-explicit-constructor): nothing is lost
  requires(fewer < words) BitSet(const BitSet<fewer>& set) : word{} {
    for (int w = 0; w < fewer; ++w) word[w] = set.word[w];
  }
  /// The set of the features 0 … n − 1. For a set of one word, n is at most 63.
  static BitSet first(int n) {
    BitSet set{};
    for (int w = 0; w < words; ++w) {
      const int bits = n - 64 * w;
      if (words > 1 && bits >= 64) {
        set.word[w] = ~std::uint64_t{0};
      } else if (words == 1 || bits > 0) {
        set.word[w] = (std::uint64_t{1} << bits) - 1;
      }
    }
    return set;
  }

  /// Inserts the features k, k + 1, … whose bits 0, 1, … are set in `bits`. All of them must be in the same word.
  void insert_bits(std::uint64_t bits, std::uint32_t k) { word[words == 1 ? 0 : k / 64] |= bits << k % 64; }
  /// Inserts feature k.
  void insert(std::uint32_t k) { insert_bits(1, k); }
  bool contains(std::uint32_t k) const { return (word[words == 1 ? 0 : k / 64] >> k % 64 & 1) != 0; }  ///< k is in it
  /// True if there is no feature in the set.
  bool empty() const {
    std::uint64_t any = 0;
    for (const std::uint64_t bits : word) any |= bits;
    return any == 0;
  }
  /// Number of features in the set.
  int count() const {
    int sum = 0;
    for (const std::uint64_t bits : word) sum += std::popcount(bits);
    return sum;
  }
  /// Calls use(k) for every feature k of the set, in ascending order.
  template <class Use>
  void for_each(const Use& use) const {
    for (int w = 0; w < words; ++w) {
      for (std::uint64_t rest = word[w]; rest; rest &= rest - 1) use(64 * w + std::countr_zero(rest));
    }
  }

  /// Inserts the features of the other set.
  BitSet& operator|=(const BitSet& other) {
    for (int w = 0; w < words; ++w) word[w] |= other.word[w];
    return *this;
  }
  /// Inserts the features of a set with fewer words.
  template <int fewer>
  requires(fewer < words) BitSet& operator|=(const BitSet<fewer>& other) {
    for (int w = 0; w < fewer; ++w) word[w] |= other.word[w];
    return *this;
  }
  /// Removes the features that are not in the other set.
  BitSet& operator&=(const BitSet& other) {
    for (int w = 0; w < words; ++w) word[w] &= other.word[w];
    return *this;
  }
  /// All indices that are not in the set, up to the size of the words.
  BitSet operator~() const {
    BitSet rest{};
    for (int w = 0; w < words; ++w) rest.word[w] = ~word[w];
    return rest;
  }
  friend BitSet operator|(BitSet a, const BitSet& b) { return a |= b; }  ///< union
  friend BitSet operator&(BitSet a, const BitSet& b) { return a &= b; }  ///< intersection
  friend bool operator==(const BitSet& a, const BitSet& b) = default;    ///< the same features
};

/// A set of features of any solid.
using FeatureSet = BitSet<3>;

}  // namespace isojam
