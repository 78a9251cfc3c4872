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

  /// Adds another evaluation's.
  PairCounts& operator+=(const PairCounts& term);
};

/// Which digits of the state an evaluation reads: those of the high parts, or of the whole double-double.
enum class Precision {
  working,       ///< doubles: enough until forces balance to residual_floor, 1e-8 and worse near jamming
  double_double  ///< low parts too: enough for a residual of 1e-9 at any distance from jamming
};

/// Calls run(block) for every block < blocks, each far more work than a task costs, parallel on oneTBB.
void for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& run);

/// Calls run(k) for every k < slots, parallel on oneTBB where there are enough of them. It may write to slot k only, so
/// that the result does not depend on the number of threads.
void for_each_slot(std::size_t slots, const std::function<void(std::size_t)>& run);

/// Room for every particle's solid; what stood there stays if packing and precision are of the kind that they were.
void make_room(const Packing& packing, Precision precision, PlacedSolids& placed);
/// Every particle's solid in its orientation, in the order of particles. `placed` is overwritten.
void place_all(const Packing& packing, Precision precision, PlacedSolids& placed);

/// Overlap of a listed pair, lab frame.
struct PairOverlap {
  std::size_t pair = 0;  ///< its place in the list
  Overlap overlap;       ///< V > 0
};

/// The pairs of a list that touch, in its order, in blocks that are made in parallel.
struct TouchingPairs {
  std::vector<std::vector<PairOverlap>> blocks;  ///< in the order of the list
};

/// Finds the touching pairs of a list, parallel over blocks of it on oneTBB where there are enough of them. `placed` as
/// place_all left it for the same precision. axes[k], of pair k, is read and updated: a cache that changes the cost and
/// never the result. `touching` is overwritten.
PairCounts overlap_pairs(const Packing& packing, Precision precision, const PlacedSolids& placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, TouchingPairs& touching);

/// The touching pairs of a list as they would be with gaps closed, B's centre closer to A's by `probe_distance`
/// (V_p^(1/3)). `axes` as overlap_pairs left them.
TouchingPairs probe_pairs(const Packing& packing, const PlacedSolids& placed, std::span<const NeighbourPair> pairs,
                          std::span<const SeparatingAxis> axes, double probe_distance);

/// PairHessian of every touching pair, in their order.
std::vector<PairHessian> pair_hessians(const Packing& packing, Precision precision, const PlacedSolids& placed,
                                       std::span<const NeighbourPair> pairs, const TouchingPairs& touching);

}  // namespace isojam
