#pragma once

#include <span>
#include <vector>

#include "engine/geometry/overlap.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/separating_axis.hpp"
#include "engine/packing/neighbours.hpp"

namespace isojam {

/// What the broad and narrow phases did in one evaluation.
struct PairCounts {
  long listed = 0;        ///< pairs in the neighbour list
  long out_of_reach = 0;  ///< circumspheres apart
  long by_axis = 0;       ///< rejected by the axis cached from an earlier evaluation
  long overlapped = 0;    ///< handed to the overlap kernel
  long clipped = 0;       ///< of these, answered by the slow path
  long touching = 0;      ///< V > 0

  PairCounts& operator+=(const PairCounts& term);
};

/// Every particle's solid in its orientation, in the order of particles. `placed` is overwritten.
void place_all(const Packing& packing, std::vector<PlacedSolid>& placed);

/// Second derivatives of one touching pair's energy, lab frame, per particle (x, R·θ), R the radius of gyration:
/// H(E) = ½ (g gᵀ + V H(V)), g = ∇V.
struct PairHessian {
  Matrix6d aa, ab, bb;
};

/// Overlap of every listed pair into its own slot (lab frame), parallel over pairs on
/// oneTBB where there are enough of them. `placed` as place_all left it. Slots of pairs that do not touch are left with
/// volume 0.
/// axes[k] is read and updated: a cache that changes the cost and never the result.
/// `hessians` may be empty; else the slots of touching pairs are filled and the others left alone.
/// All other spans have the size of `pairs`.
PairCounts overlap_pairs(const Packing& packing, std::span<const PlacedSolid> placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, std::span<Overlap> out,
                         std::span<PairHessian> hessians = {});

}  // namespace isojam
