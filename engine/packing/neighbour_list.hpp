#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/packing/neighbours.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Pairs of particles within reach and a skin, with a separating axis of each, kept while no particle has moved by more
/// than half the skin: a cache, which changes the cost of what is computed from it and never the result.
class NeighbourList {
 public:
  /// Lists the pairs of `packing`. Throws std::invalid_argument if the cell is not larger than least_side(solid).
  void refresh(const Packing& packing);

  /// In order of (a, b, shift); with centres farther apart than two circumradii too.
  const std::vector<NeighbourPair>& pairs() const { return pairs_; }
  std::vector<SeparatingAxis>& axes() { return axes_; }  ///< of pairs()

 private:
  std::vector<NeighbourPair> pairs_;
  std::vector<SeparatingAxis> axes_;
  std::vector<Eigen::Vector3d> positions_;  ///< when it was made
  double side_ = 0, skin_ = 0;
  const ConvexSolid* solid_ = nullptr;
};

}  // namespace isojam
