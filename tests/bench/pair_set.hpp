#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam::bench {

/// Particles of one solid, and pairs of them in the order of a neighbour list. Each particle is placed once.
struct PairSet {
  struct Pair {
    int a = 0, b = 0;
    Eigen::Vector3d r = Eigen::Vector3d::Zero();  ///< x_b − x_a for this image of b
  };

  PlacedSolids placed;
  std::vector<Pair> pairs;

  std::size_t size() const { return pairs.size(); }
  PlacedSolid a(std::size_t k) const { return placed[static_cast<std::size_t>(pairs[k].a)]; }
  PlacedSolid b(std::size_t k) const { return placed[static_cast<std::size_t>(pairs[k].b)]; }
  const Eigen::Vector3d& r(std::size_t k) const { return pairs[k].r; }
};

/// Pairs with random orientations and directions, and V/V_p from 1e-5 to 3e-2. There are so many different pairs that a
/// branch predictor cannot learn them. Later calls with the same argument return the same object.
const PairSet& touching_pairs(SolidKind kind);

/// Pairs with V/V_p from 1e-5 to 3e-2 in a packing of relaxed() with 10⁴ particles, in the order in which the energy
/// evaluates them.
const PairSet& packing_pairs(SolidKind kind);

/// The same number of pairs as touching_pairs(), without contact, but with circumspheres that overlap.
const PairSet& separated_pairs(SolidKind kind);

}  // namespace isojam::bench
