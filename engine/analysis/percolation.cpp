#include "engine/analysis/percolation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace isojam {

Percolation percolation(const Packing& packing, std::span<const NeighbourPair> bonds) {
  Percolation result;
  double squares = 0;
  int largest = 0;
  for (const Cluster& cluster : find_clusters(packing, bonds)) {
    squares += static_cast<double>(cluster.size()) * cluster.size();
    largest = std::max(largest, cluster.size());
    result.winding_rank = std::max(result.winding_rank, cluster.winding_rank());
    ++result.sizes[cluster.size()];
  }
  const double particles = packing.size();
  result.S = squares / particles;
  result.largest = largest / particles;
  return result;
}

RandomPercolation random_percolation(const Packing& packing, std::span<const NeighbourPair> contacts, std::size_t bonds,
                                     int draws, RandomStream& random) {
  if (bonds > contacts.size()) throw std::invalid_argument("there are fewer contacts than bonds");
  if (draws < 1) throw std::invalid_argument("at least one draw is needed");
  std::vector<NeighbourPair> order(contacts.begin(), contacts.end());
  RandomPercolation sum;  // divided by the number of draws at the end, so that a share is at most 1
  for (int draw = 0; draw < draws; ++draw) {
    // The first steps of a Fisher–Yates shuffle choose the bonds.
    for (std::size_t k = 0; k < bonds; ++k) {
      const auto left = static_cast<double>(order.size() - k);
      std::swap(order[k], order[k + static_cast<std::size_t>(random.uniform() * left)]);
    }
    const Percolation drawn = percolation(packing, std::span(order).first(bonds));
    sum.S += drawn.S;
    sum.largest += drawn.largest;
    for (int rank = 1; rank <= drawn.winding_rank; ++rank) ++sum.winds[static_cast<std::size_t>(rank - 1)];
  }
  RandomPercolation mean{sum.S / draws, sum.largest / draws, sum.winds};
  for (double& share : mean.winds) share /= draws;
  return mean;
}

}  // namespace isojam
