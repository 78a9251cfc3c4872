#pragma once

#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam {

/// Two particles a < b that may touch, and the periodic image of b that may touch a. The displacement from a to this
/// image is x_b − x_a + h·shift, where the columns of h are the lattice vectors. A list of pairs may contain the same a
/// and b with several shifts. The functions below never return a = b, because no particle can touch its own image in a
/// legal cell (is_legal() in cell/periodic_cell.hpp).
struct NeighbourPair {
  int a = 0, b = 0;  ///< indices of the particles, a < b
  /// image of b: multiples of the lattice vectors by which it is displaced from b
  Eigen::Vector3i shift = Eigen::Vector3i::Zero();
};

/// Key by which all lists of pairs are sorted: (a, b, shift).
inline auto canonical_key(const NeighbourPair& p) {
  return std::make_tuple(p.a, p.b, p.shift[0], p.shift[1], p.shift[2]);
}

/// Displacement x_b − x_a + h·shift of a pair in double precision. Pose::position_low is ignored.
inline Eigen::Vector3d displacement(const Packing& packing, const NeighbourPair& pair) {
  return packing.poses[static_cast<std::size_t>(pair.b)].position -
         packing.poses[static_cast<std::size_t>(pair.a)].position + packing.cell.translation(pair.shift);
}
/// The same displacement in double-double, with Pose::position_low.
DoubleDoubleVector displacement_double_double(const Packing& packing, const NeighbourPair& pair);

/// Finds all pairs whose centres are closer than `reach` (V_p^(1/3)), with all periodic images of b. The result is
/// sorted by (a, b, shift). The time is O(N), because the particles are sorted into a grid. Opposite faces of a grid
/// cell have at least the distance `reach`. If fewer than 3 grid cells fit along a lattice vector, the function tests
/// all pairs instead.
std::vector<NeighbourPair> find_neighbours(const Packing& packing, double reach);

/// Finds all pairs whose circumscribed spheres intersect or have a gap smaller than `skin` (V_p^(1/3)), with all
/// periodic images of b. The result is sorted by (a, b, shift). The particles are divided into size classes. In a size
/// class, the largest circumradius is at most twice the smallest. Each size class has its own grid, so that large
/// particles do not slow down the search for neighbours of small particles.
std::vector<NeighbourPair> find_in_reach(const Packing& packing, double skin);
/// Computes the result of find_in_reach() by a test of all pairs. Tests use it as the reference.
std::vector<NeighbourPair> find_in_reach_brute_force(const Packing& packing, double skin);

/// Computes the result of find_neighbours() by a test of all pairs. Tests use it as the reference.
std::vector<NeighbourPair> find_neighbours_brute_force(const Packing& packing, double reach);

}  // namespace isojam
