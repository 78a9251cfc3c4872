#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/packing/neighbours.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

/// Counts of what the broad and narrow phases did in one evaluation.
struct PairCounts {
  long listed = 0;        ///< pairs in the neighbour list
  long out_of_reach = 0;  ///< circumspheres apart
  long by_axis = 0;       ///< rejected by the axis cached from an earlier evaluation
  long overlapped = 0;    ///< handed to the overlap kernel
  long clipped = 0;       ///< of these, answered by the slow path
  long touching = 0;      ///< V > 0

  PairCounts& operator+=(const PairCounts& term);
};

/// Which digits of the state an evaluation reads: those of the high parts, or of the whole double-double.
enum class Precision {
  working,       ///< doubles: enough until forces balance to residual_floor, 1e-8 and worse near jamming
  double_double  ///< low parts too: enough for a residual of 1e-9 at any distance from jamming
};

/// Calls run(k) for every k < slots, parallel on oneTBB where there are enough of them. It may write to slot k only, so
/// that the result does not depend on the number of threads.
void for_each_slot(std::size_t slots, const std::function<void(std::size_t)>& run);

/// Every particle's solid in its orientation, in the order of particles. `placed` is overwritten.
void place_all(const Packing& packing, Precision precision, std::vector<PlacedSolid>& placed);

/// Overlap of every listed pair into its own slot (lab frame), parallel over pairs on oneTBB where there are enough of
/// them. `placed` as place_all left it for the same precision. Slots of pairs that do not touch are left with volume 0.
/// axes[k] is read and updated: a cache that changes the cost and never the result. All spans have the size of `pairs`.
PairCounts overlap_pairs(const Packing& packing, Precision precision, std::span<const PlacedSolid> placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, std::span<Overlap> out);

/// Overlap of every listed pair as it would be with the gap closed, B's centre closer to A's by `probe_distance`
/// (V_p^(1/3)); volume 0 where they would still be apart. `axes` as overlap_pairs left them.
void probe_pairs(const Packing& packing, std::span<const PlacedSolid> placed, std::span<const NeighbourPair> pairs,
                 std::span<const SeparatingAxis> axes, double probe_distance, std::span<Overlap> out);

/// PairHessian of every touching pair into its own slot; the others are left alone. `overlaps` as overlap_pairs left
/// them.
void pair_hessians(const Packing& packing, Precision precision, std::span<const PlacedSolid> placed,
                   std::span<const NeighbourPair> pairs, std::span<const Overlap> overlaps, std::span<PairHessian> out);

}  // namespace isojam
