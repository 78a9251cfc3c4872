#include "engine/analysis/gaps.hpp"

#include <stdexcept>

#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/packing/pair_loop.hpp"
#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

/// True if planes parallel to a face are as far apart as those of the best axis, within rounding errors. A product of
/// two edges can then have the same planes, but no better ones.
bool is_of_faces(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, double width) {
  const double enough = width - gap_tolerance(a, b, pose);
  const auto apart = [&](SeparatingAxis::Kind kind, std::size_t face) {
    const auto index = static_cast<std::uint8_t>(face);
    return gap(a, b, pose, {kind, index, index}) >= enough;
  };
  for (std::size_t f = 0; f < a.faces().size(); ++f) {
    if (apart(SeparatingAxis::Kind::face_a, f)) return true;
  }
  for (std::size_t f = 0; f < b.faces().size(); ++f) {
    if (apart(SeparatingAxis::Kind::face_b, f)) return true;
  }
  return false;
}

}  // namespace

std::vector<Gap> near_gaps(const Packing& packing, double widest) {
  if (!(widest > 0)) throw std::invalid_argument("the largest gap must be positive");
  const auto pairs = find_in_reach(packing, widest);
  PlacedSolids placed;
  place_all(packing, Precision::working, placed);
  std::vector<Gap> all(pairs.size());
  for_each_small(pairs.size(), [&](std::size_t k) {
    const PlacedSolid a = placed[static_cast<std::size_t>(pairs[k].a)],
                      b = placed[static_cast<std::size_t>(pairs[k].b)];
    const Eigen::Matrix3d to_a = a.rotation().transpose();
    const RelativePose pose{to_a * b.rotation(), to_a * displacement(packing, pairs[k])};
    const double width = gap(a.solid(), b.solid(), pose, best_axis(a.solid(), b.solid(), pose));
    const bool near = width > 0 && width < widest;
    all[k] = {pairs[k], width, near && is_of_faces(a.solid(), b.solid(), pose, width)};
  });
  std::vector<Gap> gaps;
  for (const Gap& gap : all) {
    if (gap.width > 0 && gap.width < widest) gaps.push_back(gap);
  }
  return gaps;
}

}  // namespace isojam
