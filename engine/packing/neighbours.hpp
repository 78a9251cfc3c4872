#pragma once

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam {

/// Particles a < b whose centres may be within reach; x_b − x_a + h·shift is their displacement, the
/// columns of h being the lattice vectors.
/// a == b never occurs in a legal cell; the same (a, b) may occur with several shifts.
struct NeighbourPair {
  int a = 0, b = 0;                                 ///< particles, a < b
  Eigen::Vector3i shift = Eigen::Vector3i::Zero();  ///< lattice vectors from b to the image that is meant
};

/// The order of pairs everywhere: by (a, b, shift).
inline auto canonical_key(const NeighbourPair& p) {
  return std::make_tuple(p.a, p.b, p.shift[0], p.shift[1], p.shift[2]);
}

/// Displacement x_b − x_a + h·shift of a pair, from the high parts of positions.
inline Eigen::Vector3d displacement(const Packing& packing, const NeighbourPair& pair) {
  return packing.poses[static_cast<std::size_t>(pair.b)].position -
         packing.poses[static_cast<std::size_t>(pair.a)].position + packing.cell.translation(pair.shift);
}
/// Displacement in double-double, from the low parts of positions too.
DoubleDoubleVector displacement_double_double(const Packing& packing, const NeighbourPair& pair);

/// All pairs and images with centre distance < reach, in order of (a, b, shift). O(N) by a grid whose cells are reach
/// or more from face to face, or brute force where that is fewer than 3 along some lattice vector.
std::vector<NeighbourPair> find_neighbours(const Packing& packing, double reach);

/// All pairs and images that are no farther apart than their circumradii and `skin`, in the same order. By a grid for
/// each of the classes of size, radii of a class within a factor of 2: small particles pay nothing for large ones.
std::vector<NeighbourPair> find_in_reach(const Packing& packing, double skin);
/// find_in_reach() from all pairs: the oracle.
std::vector<NeighbourPair> find_in_reach_brute_force(const Packing& packing, double skin);

/// find_neighbours() from all N(N−1)/2 pairs: the oracle.
std::vector<NeighbourPair> find_neighbours_brute_force(const Packing& packing, double reach);

}  // namespace isojam
