#include "engine/analysis/gaps.hpp"

#include <stdexcept>

#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

std::vector<Gap> near_gaps(const Packing& packing, double widest) {
  if (!(widest > 0)) throw std::invalid_argument("gaps are looked for up to a positive width");
  const auto pairs = find_in_reach(packing, widest);
  PlacedSolids placed;
  place_all(packing, Precision::working, placed);
  std::vector<Gap> all(pairs.size());
  for_each_slot(pairs.size(), [&](std::size_t k) {
    const PlacedSolid a = placed[static_cast<std::size_t>(pairs[k].a)],
                      b = placed[static_cast<std::size_t>(pairs[k].b)];
    const Eigen::Matrix3d to_a = a.rotation().transpose();
    const RelativePose pose{to_a * b.rotation(), to_a * displacement(packing, pairs[k])};
    const SeparatingAxis axis = best_axis(a.solid(), b.solid(), pose);
    all[k] = {pairs[k], gap(a.solid(), b.solid(), pose, axis), axis.kind != SeparatingAxis::Kind::edge_edge};
  });
  std::vector<Gap> gaps;
  for (const Gap& gap : all) {
    if (gap.width > 0 && gap.width < widest) gaps.push_back(gap);
  }
  return gaps;
}

}  // namespace isojam
