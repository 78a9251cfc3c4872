#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/packing/neighbours.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Neighbour list: all pairs of particles whose circumscribed spheres intersect, or have a gap smaller than a skin,
/// when the list is made. For each pair, the list also stores the last separating axis that was found. refresh() makes
/// a new list only if the particles or the cell have moved so far that a pair outside the list could touch. The list is
/// a cache: it changes the cost of a computation, but never the result.
class NeighbourList {
 public:
  /// Updates the list for `packing`. Throws std::invalid_argument if the cell is not legal for the particles
  /// (is_legal() in cell/periodic_cell.hpp).
  void refresh(const Packing& packing);

  /// Pairs sorted by (a, b, shift). Some of them do not touch: their circumscribed spheres may have a gap.
  const std::vector<NeighbourPair>& pairs() const { return pairs_; }
  std::vector<SeparatingAxis>& axes() { return axes_; }  ///< separating axis of each pair, in the order of pairs()

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
