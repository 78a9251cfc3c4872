#pragma once

#include <span>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/packing/neighbours.hpp"
#include "engine/packing/pair_energy.hpp"

namespace isojam {

/// Numbers of pairs in one evaluation: all pairs of the neighbour list, and the pairs that each test found.
struct PairCounts {
  long listed = 0;        ///< pairs in the neighbour list
  long out_of_reach = 0;  ///< pairs whose circumscribed spheres do not intersect
  long by_axis = 0;       ///< pairs that the separating axis of an earlier evaluation separates
  long overlapped = 0;    ///< pairs whose overlap was computed
  /// the part of `overlapped` that clipped_overlap() computed, which is slower but also works for degenerate pairs
  long clipped = 0;
  long touching = 0;  ///< pairs with V > 0

  /// Adds the counts of another evaluation.
  PairCounts& operator+=(const PairCounts& term);
};

/// Precision of the coordinates in an evaluation. A Pose stores each coordinate as the sum of two doubles.
enum class Precision {
  /// Only the first double of each coordinate is used. This is sufficient for residuals above
  /// Evaluation::residual_floor, which is 1e-8 or more near jamming.
  working,
  double_double  ///< both doubles are used, which is sufficient for a residual of 1e-9 at any distance to jamming
};

/// Allocates memory in `placed` for the solid of every particle. The previous content is kept if the solids and the
/// precision have not changed.
void make_room(const Packing& packing, Precision precision, PlacedSolids& placed);
/// Rotates the solid of every particle into the lab frame. `placed` is overwritten and contains the solids in the order
/// of the particles.
void place_all(const Packing& packing, Precision precision, PlacedSolids& placed);

/// Computes the overlap of one pair of the neighbour list with Precision::working. The overlap is empty if the
/// circumscribed spheres do not intersect or if `axis` separates the pair. Otherwise `axis` is updated.
Overlap overlap_listed(const Packing& packing, const PlacedSolids& placed, const NeighbourPair& pair,
                       SeparatingAxis& axis);

/// Overlap of one pair of a neighbour list; vectors are in the lab frame.
struct PairOverlap {
  std::size_t pair = 0;  ///< index of the pair in the list
  Overlap overlap;       ///< V > 0
};

/// The touching pairs of a neighbour list, divided into blocks that are computed in parallel.
struct TouchingPairs {
  std::vector<std::vector<PairOverlap>> blocks;  ///< in the order of the list
};

/// Finds the touching pairs of a list. `placed` must come from place_all() with the same precision. axes[k] is the
/// separating axis of pair k from an earlier call, and is updated. The axes change the cost, but never the result.
/// `touching` is overwritten.
PairCounts overlap_pairs(const Packing& packing, Precision precision, const PlacedSolids& placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, TouchingPairs& touching);

/// Finds the pairs of a list that would touch if the centre of B were closer to the centre of A by `probe_distance`
/// (V_p^(1/3)), and computes their overlaps at this smaller distance. `axes` must come from overlap_pairs().
TouchingPairs probe_pairs(const Packing& packing, const PlacedSolids& placed, std::span<const NeighbourPair> pairs,
                          std::span<const SeparatingAxis> axes, double probe_distance);

/// Computes the PairHessian of every touching pair, in the order of `touching`.
std::vector<PairHessian> pair_hessians(const Packing& packing, Precision precision, const PlacedSolids& placed,
                                       std::span<const NeighbourPair> pairs, const TouchingPairs& touching);

/// Computes the second derivatives of V for every touching pair, in the order of `touching`. The coordinates are
/// (x, R·θ) with the radii of gyration R of the particles `solids`, whose sizes may differ from those in `packing`.
std::vector<PairHessian> volume_hessians(const Packing& packing, Precision precision, const PlacedSolids& placed,
                                         std::span<const NeighbourPair> pairs, const TouchingPairs& touching,
                                         const Composition& solids);

}  // namespace isojam
