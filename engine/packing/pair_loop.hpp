#pragma once

#include <span>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/packing/neighbours.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

/// Numbers of pairs that one evaluation processed, by the step that decided whether they touch.
struct PairCounts {
  long listed = 0;        ///< pairs in the neighbour list
  long out_of_reach = 0;  ///< pairs whose circumscribed spheres do not intersect
  long by_axis = 0;       ///< pairs that the separating axis from an earlier evaluation still separates
  long overlapped = 0;    ///< pairs whose overlap was computed
  /// pairs of `overlapped` that needed clipped_overlap(), which is slower but works for degenerate pairs
  long clipped = 0;
  long touching = 0;  ///< pairs with V > 0

  /// Adds the counts of another evaluation.
  PairCounts& operator+=(const PairCounts& term);
};

/// Precision of the coordinates that an evaluation uses. A state stores each coordinate as the sum of two doubles.
enum class Precision {
  /// only the first double of each coordinate: enough until the residual reaches Evaluation::residual_floor, which is
  /// 1e-8 or more near jamming
  working,
  double_double  ///< both doubles of each coordinate: enough for a residual of 1e-9 at any distance to jamming
};

/// Allocates memory in `placed` for the solid of every particle. If neither the solids nor the precision have changed,
/// the previous content is kept.
void make_room(const Packing& packing, Precision precision, PlacedSolids& placed);
/// Computes, for every particle, the solid rotated into the lab frame. `placed` is overwritten; its elements are in the
/// order of the particles.
void place_all(const Packing& packing, Precision precision, PlacedSolids& placed);

/// Computes the overlap of a pair of the neighbour list with Precision::working. The result is an empty overlap if the
/// circumscribed spheres do not intersect or if `axis` separates the pair. `axis` is updated.
Overlap overlap_listed(const Packing& packing, const PlacedSolids& placed, const NeighbourPair& pair,
                       SeparatingAxis& axis);

/// Overlap of one pair of a neighbour list; vectors are in the lab frame.
struct PairOverlap {
  std::size_t pair = 0;  ///< index of the pair in the list
  Overlap overlap;       ///< V > 0
};

/// The touching pairs of a neighbour list. They are divided into blocks, which are computed in parallel.
struct TouchingPairs {
  std::vector<std::vector<PairOverlap>> blocks;  ///< blocks, and the pairs in each block, in the order of the list
};

/// Finds the touching pairs of a list. Several threads compute the blocks if there are enough of them. `placed` must
/// come from place_all() with the same precision. axes[k] is the separating axis of pair k from an earlier call; it is
/// read and updated. It is a cache, which changes the cost but never the result. `touching` is overwritten.
PairCounts overlap_pairs(const Packing& packing, Precision precision, const PlacedSolids& placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, TouchingPairs& touching);

/// Finds the pairs of a list that touch if the centre of B is moved towards the centre of A by `probe_distance`
/// (V_p^(1/3)). `axes` must come from overlap_pairs().
TouchingPairs probe_pairs(const Packing& packing, const PlacedSolids& placed, std::span<const NeighbourPair> pairs,
                          std::span<const SeparatingAxis> axes, double probe_distance);

/// Computes the PairHessian of every touching pair, in the order of `touching`.
std::vector<PairHessian> pair_hessians(const Packing& packing, Precision precision, const PlacedSolids& placed,
                                       std::span<const NeighbourPair> pairs, const TouchingPairs& touching);

}  // namespace isojam
