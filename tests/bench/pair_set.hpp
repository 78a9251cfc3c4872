#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam::bench {

/// Particles of one solid, each placed once, and pairs in the order of a neighbour list.
struct PairSet {
  struct Pair {
    int a = 0, b = 0;
    Eigen::Vector3d r = Eigen::Vector3d::Zero();  ///< x_b − x_a
  };

  PlacedSolids placed;
  std::vector<Pair> pairs;

  std::size_t size() const { return pairs.size(); }
  PlacedSolid a(std::size_t k) const { return placed[static_cast<std::size_t>(pairs[k].a)]; }
  PlacedSolid b(std::size_t k) const { return placed[static_cast<std::size_t>(pairs[k].b)]; }
  const Eigen::Vector3d& r(std::size_t k) const { return pairs[k].r; }
};

/// Random orientations and directions, V/V_p in 1e-5 … 3e-2. There are too many different pairs for a branch predictor
/// to learn. Kept from one call to the next.
const PairSet& touching_pairs(SolidKind kind);

/// The pairs of compressed packings of N particles with this overlap, packing after packing, in the order in which each
/// evaluates them; 10⁴ particles in total.
const PairSet& packing_pairs(SolidKind kind, int n);

/// The same for separated pairs whose circumspheres overlap.
const PairSet& separated_pairs(SolidKind kind);

}  // namespace isojam::bench
