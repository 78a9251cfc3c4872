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

/// Counts from the broad and narrow phases of one evaluation.
struct PairCounts {
  long listed = 0;        ///< pairs in the neighbour list
  long out_of_reach = 0;  ///< circumspheres do not intersect
  long by_axis = 0;       ///< rejected by the axis cached from an earlier evaluation
  long overlapped = 0;    ///< passed to the overlap kernel
  long clipped = 0;       ///< those of them computed by the slow path
  long touching = 0;      ///< pairs with V > 0

  /// Adds the counts of another evaluation.
  PairCounts& operator+=(const PairCounts& term);
};

/// Digits of the state that an evaluation uses: high parts, or the whole double-double.
enum class Precision {
  working,       ///< doubles: enough until the force residual reaches residual_floor, 1e-8 or worse near jamming
  double_double  ///< low parts too: enough for a residual of 1e-9 at any distance from jamming
};

/// Calls run(block) for every block < blocks, in parallel by oneTBB. Each call must be far longer than the cost of a
/// task.
void for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& run);

/// Calls run(k) for every k < slots, in parallel by oneTBB if there are enough slots. A call may write only to slot k,
/// so that the result does not depend on the number of threads.
void for_each_slot(std::size_t slots, const std::function<void(std::size_t)>& run);

/// Allocates memory for every particle's solid. The previous content is kept if the kinds of packing and precision have
/// not changed.
void make_room(const Packing& packing, Precision precision, PlacedSolids& placed);
/// Places every particle's solid in its orientation, in the order of particles. `placed` is overwritten.
void place_all(const Packing& packing, Precision precision, PlacedSolids& placed);

/// Overlap of a listed pair, lab frame.
struct PairOverlap {
  std::size_t pair = 0;  ///< index in the list
  Overlap overlap;       ///< V > 0
};

/// The touching pairs of a list, in its order, in blocks that are computed in parallel.
struct TouchingPairs {
  std::vector<std::vector<PairOverlap>> blocks;  ///< in the order of the list
};

/// Finds the touching pairs of a list, in parallel by oneTBB if there are enough blocks. `placed` comes from
/// place_all() with the same precision. axes[k], the axis of pair k, is read and updated: a cache that changes the cost
/// and never the result. `touching` is overwritten.
PairCounts overlap_pairs(const Packing& packing, Precision precision, const PlacedSolids& placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, TouchingPairs& touching);

/// The touching pairs of a list after closing gaps: B's centre is moved closer to A's by `probe_distance` (V_p^(1/3)).
/// `axes` come from overlap_pairs().
TouchingPairs probe_pairs(const Packing& packing, const PlacedSolids& placed, std::span<const NeighbourPair> pairs,
                          std::span<const SeparatingAxis> axes, double probe_distance);

/// PairHessian of every touching pair, in the same order.
std::vector<PairHessian> pair_hessians(const Packing& packing, Precision precision, const PlacedSolids& placed,
                                       std::span<const NeighbourPair> pairs, const TouchingPairs& touching);

}  // namespace isojam
