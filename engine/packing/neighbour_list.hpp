#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/packing/neighbours.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Pairs of particles within reach plus a skin, each with a separating axis. The list is kept until particles or cell
/// have moved so far that an unlisted pair could be within reach. It is a cache: it changes the cost of a computation,
/// and never the result.
class NeighbourList {
 public:
  /// Updates the list for `packing`. Throws std::invalid_argument unless is_legal(cell, solids.widest()).
  void refresh(const Packing& packing);

  /// Pairs sorted by (a, b, shift), including pairs in the skin, whose circumspheres do not intersect.
  const std::vector<NeighbourPair>& pairs() const { return pairs_; }
  std::vector<SeparatingAxis>& axes() { return axes_; }  ///< the axes of pairs()

 private:
  bool is_valid(const Packing& packing) const;

  std::vector<NeighbourPair> pairs_;
  std::vector<SeparatingAxis> axes_;
  std::vector<Eigen::Vector3d> positions_;  ///< positions for which the list was made
  std::optional<PeriodicCell> cell_;
  double reach_ = 0, skin_ = 0;
  std::optional<Composition> solids_;
};

}  // namespace isojam
