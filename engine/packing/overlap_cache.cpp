#include "engine/packing/overlap_cache.hpp"

namespace isojam {

void OverlapCache::update(const Packing& packing, Precision precision, PairCounts& counts) {
  const bool known = solids_ == packing.solids && cell_ && *cell_ == packing.cell && poses_ == packing.poses &&
                     precision_ == precision;
  if (known) return;
  poses_.clear();
  list_.refresh(packing);
  place_all(packing, precision, placed_);
  counts += overlap_pairs(packing, precision, placed_, list_.pairs(), list_.axes(), touching_);
  poses_ = packing.poses;
  cell_ = packing.cell;
  solids_ = packing.solids;
  precision_ = precision;
}

std::vector<PairHessian> OverlapCache::hessians(const Packing& packing) const {
  return pair_hessians(packing, precision_, placed_, list_.pairs(), touching_);
}

std::vector<PairHessian> OverlapCache::volume_hessians(const Packing& packing, const Composition& solids) const {
  return isojam::volume_hessians(packing, precision_, placed_, list_.pairs(), touching_, solids);
}

TouchingPairs OverlapCache::probe(const Packing& packing, double probe_distance) {
  return probe_pairs(packing, placed_, list_.pairs(), list_.axes(), probe_distance);
}

}  // namespace isojam
