#include "engine/analysis/pair_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/parallel/parallel.hpp"

namespace isojam {

std::vector<double> pair_distribution(const Packing& packing, double width, double farthest) {
  if (!(width > 0)) throw std::invalid_argument("the width of the bins must be positive");
  const double end = std::min(farthest, packing.cell.shortest_translation() / 2);
  const auto bins = static_cast<std::size_t>(std::max(0.0, std::floor(end / width * (1 + 1e-12))));
  const auto n = packing.poses.size();
  // Every particle counts its own neighbours, so that the result does not depend on the number of threads.
  std::vector<std::vector<long>> of_particle(n);
  for_each_small(n, [&](std::size_t i) {
    auto& counts = of_particle[i];
    counts.assign(bins, 0);
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const double r = packing.cell.nearest_image(packing.poses[j].position - packing.poses[i].position).norm();
      if (r < width * static_cast<double>(bins)) ++counts[std::min(bins - 1, static_cast<std::size_t>(r / width))];
    }
  });
  std::vector<double> g(bins, 0);
  for (std::size_t k = 0; k < bins; ++k) {
    long pairs = 0;
    for (const auto& counts : of_particle) pairs += counts[k];
    const double inner = width * static_cast<double>(k), outer = width * static_cast<double>(k + 1);
    const double shell = 4 * std::numbers::pi / 3 * (outer * outer * outer - inner * inner * inner);
    g[k] =
        static_cast<double>(pairs) / (static_cast<double>(n) * shell * static_cast<double>(n) / packing.cell.volume());
  }
  return g;
}

}  // namespace isojam
