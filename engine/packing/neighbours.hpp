#pragma once

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam {

/// Particles a < b whose centres may be within reach. Their displacement is x_b − x_a + h·shift, where the columns of h
/// are the lattice vectors. a == b never occurs in a legal cell; the same (a, b) may occur with several shifts.
struct NeighbourPair {
  int a = 0, b = 0;                                 ///< particles, a < b
  Eigen::Vector3i shift = Eigen::Vector3i::Zero();  ///< lattice vectors from b to its image
};

/// Sort key of pairs everywhere: (a, b, shift).
inline auto canonical_key(const NeighbourPair& p) {
  return std::make_tuple(p.a, p.b, p.shift[0], p.shift[1], p.shift[2]);
}

/// Displacement x_b − x_a + h·shift of a pair, from the high parts of positions.
inline Eigen::Vector3d displacement(const Packing& packing, const NeighbourPair& pair) {
  return packing.poses[static_cast<std::size_t>(pair.b)].position -
         packing.poses[static_cast<std::size_t>(pair.a)].position + packing.cell.translation(pair.shift);
}
/// Displacement in double-double, with the low parts of positions.
DoubleDoubleVector displacement_double_double(const Packing& packing, const NeighbourPair& pair);

/// All pairs and images with a centre distance below `reach`, sorted by (a, b, shift). O(N) with a grid whose cells are
/// at least `reach` from face to face; brute force if fewer than 3 such cells fit along a lattice vector.
std::vector<NeighbourPair> find_neighbours(const Packing& packing, double reach);

/// All pairs and images whose distance is at most the sum of their circumradii plus `skin`, in the same order. There is
/// a grid for each size class (radii within a factor of 2), so that large particles do not slow down the search for
/// small ones.
std::vector<NeighbourPair> find_in_reach(const Packing& packing, double skin);
/// find_in_reach() by testing all pairs: the test oracle.
std::vector<NeighbourPair> find_in_reach_brute_force(const Packing& packing, double skin);

/// find_neighbours() by testing all N(N−1)/2 pairs: the test oracle.
std::vector<NeighbourPair> find_neighbours_brute_force(const Packing& packing, double reach);

}  // namespace isojam
