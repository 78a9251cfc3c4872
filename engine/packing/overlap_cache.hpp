#pragma once

#include <optional>
#include <vector>

#include "engine/packing/neighbour_list.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// The overlaps of all touching pairs of a packing. An object contains only caches: the result for a packing does not
/// depend on earlier calls.
class OverlapCache {
 public:
  /// Computes the overlaps, unless the last call had the same arguments. Adds the numbers of pairs to `counts`. Throws
  /// std::invalid_argument if the cell is not legal for the particles (is_legal() in cell/periodic_cell.hpp).
  void update(const Packing& packing, Precision precision, PairCounts& counts);
  /// Drops the overlaps, so that the next update() computes and counts them even if the packing is the same.
  void forget() { poses_.clear(); }

  // The next functions describe the packing of the last update().
  const std::vector<NeighbourPair>& pairs() const { return list_.pairs(); }  ///< pairs of the neighbour list
  const TouchingPairs& touching() const { return touching_; }                ///< touching pairs of this list
  /// Computes the PairHessian of every touching pair, in the order of touching().
  std::vector<PairHessian> hessians(const Packing& packing) const;
  /// Computes the second derivatives of V for every touching pair, see isojam::volume_hessians().
  std::vector<PairHessian> volume_hessians(const Packing& packing, const Composition& solids) const;
  /// Finds the pairs that would touch at a smaller distance, see probe_pairs().
  TouchingPairs probe(const Packing& packing, double probe_distance);

 private:
  NeighbourList list_;
  PlacedSolids placed_;
  TouchingPairs touching_;
  std::vector<Pose> poses_;  ///< poses of the packing to which touching_ belongs
  std::optional<PeriodicCell> cell_;
  std::optional<Composition> solids_;
  Precision precision_ = Precision::working;
};

}  // namespace isojam
