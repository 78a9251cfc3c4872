#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/packing/neighbours.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Pairs of particles within reach and a skin, with a separating axis of each, kept while neither particles nor cell
/// have moved so far that a pair beyond the skin can be within reach: a cache, which changes the cost of what is
/// computed from it and never the result.
class NeighbourList {
 public:
  /// Lists the pairs of `packing`. Throws std::invalid_argument unless is_legal(cell, solids.widest()).
  void refresh(const Packing& packing);

  /// In order of (a, b, shift); with centres farther apart than both circumradii too.
  const std::vector<NeighbourPair>& pairs() const { return pairs_; }
  std::vector<SeparatingAxis>& axes() { return axes_; }  ///< of pairs()

 private:
  bool is_valid(const Packing& packing) const;

  std::vector<NeighbourPair> pairs_;
  std::vector<SeparatingAxis> axes_;
  std::vector<Eigen::Vector3d> positions_;  ///< when it was made
  std::optional<PeriodicCell> cell_;
  double reach_ = 0, skin_ = 0;
  std::optional<Composition> solids_;
};

}  // namespace isojam
