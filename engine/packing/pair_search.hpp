#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "engine/packing/neighbours.hpp"

namespace isojam {

/// Finds the elements of a list that belong to given pairs. The list must be sorted by canonical_key(). Successive
/// calls of find() must request pairs in ascending order, so that all calls together pass over the list only once.
/// `pair_of` gives the pair of an element. By default, the element itself is the pair.
template <class Element, class PairOf = std::identity>
class PairSearch {
 public:
  explicit PairSearch(std::span<const Element> list, PairOf pair_of = {}) : list_(list), pair_of_(pair_of) {}

  /// The element with this pair, or null if there is no such element.
  const Element* find(const NeighbourPair& pair) {
    const auto key = canonical_key(pair);
    while (next_ < list_.size() && key_of_next() < key) ++next_;
    return next_ < list_.size() && key_of_next() == key ? &list_[next_] : nullptr;
  }

 private:
  auto key_of_next() const { return canonical_key(std::invoke(pair_of_, list_[next_])); }

  std::span<const Element> list_;
  PairOf pair_of_;
  std::size_t next_ = 0;
};

}  // namespace isojam
