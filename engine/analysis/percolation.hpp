#pragma once

#include <array>
#include <map>
#include <span>

#include "engine/analysis/clusters.hpp"
#include "engine/random/stream.hpp"

namespace isojam {

/// Sizes and windings of all clusters of a packing. Single particles are clusters too.
struct Percolation {
  double S = 0;              ///< mean size Σs²/Σs, see ClusterStatistics
  double largest = 0;        ///< number of particles in the largest cluster, divided by N
  int winding_rank = 0;      ///< largest Cluster::winding_rank()
  std::map<int, int> sizes;  ///< number n_s of clusters with s particles, by s
};

/// Computes the sizes and windings. `bonds` are as in find_clusters().
Percolation percolation(const Packing& packing, std::span<const NeighbourPair> bonds);

/// Means over draws of random bonds.
struct RandomPercolation {
  double S = 0, largest = 0;      ///< means of Percolation::S and Percolation::largest
  std::array<double, 3> winds{};  ///< share of the draws with Percolation::winding_rank of at least 1, 2 and 3
};

/// The null hypothesis of random bond percolation on the contacts of a packing. Each draw chooses `bonds` of the
/// contacts at random, all different and with equal probability. Throws std::invalid_argument if there are fewer
/// contacts than bonds, or unless draws > 0.
RandomPercolation random_percolation(const Packing& packing, std::span<const NeighbourPair> contacts, std::size_t bonds,
                                     int draws, RandomStream& random);

}  // namespace isojam
