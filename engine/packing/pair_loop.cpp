#include "engine/packing/pair_loop.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <vector>

namespace isojam {

namespace {

/// Pairs handled as one task: some 50 µs, far more than a task costs, few enough to share out.
constexpr std::size_t grain = 128;

void overlap_pair(const Packing& packing, const NeighbourPair& pair, SeparatingAxis& axis, Overlap& out,
                  PairCounts& counts) {
  const ConvexSolid& solid = *packing.solid;
  const Eigen::Vector3d d = displacement(packing, pair);
  ++counts.listed;
  out = {};
  const double reach = 2 * solid.circumradius();
  if (d.squaredNorm() >= reach * reach) {
    ++counts.out_of_reach;
    return;
  }
  const RelativePose pose = relative_pose(packing.poses[static_cast<std::size_t>(pair.a)].orientation,
                                          packing.poses[static_cast<std::size_t>(pair.b)].orientation, d);
  if (axis.kind != SeparatingAxis::Kind::none && gap(solid, solid, pose, axis) > gap_tolerance(solid, solid, pose)) {
    ++counts.by_axis;
    return;
  }
  ++counts.overlapped;
  out = overlap(solid, solid, pose, axis);
  if (out.path == OverlapPath::clip) ++counts.clipped;
  if (out.touching()) ++counts.touching;
  // No face separates: an edge pair does, and it is worth a search once.
  if (!out.touching() && axis.kind == SeparatingAxis::Kind::none) axis = best_axis(solid, solid, pose);
}

}  // namespace

PairCounts& PairCounts::operator+=(const PairCounts& term) {
  listed += term.listed;
  out_of_reach += term.out_of_reach;
  by_axis += term.by_axis;
  overlapped += term.overlapped;
  clipped += term.clipped;
  touching += term.touching;
  return *this;
}

PairCounts overlap_pairs(const Packing& packing, std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes,
                         std::span<Overlap> out) {
  assert(axes.size() == pairs.size() && out.size() == pairs.size());
  const std::size_t n = pairs.size();
  const std::size_t blocks = (n + grain - 1) / grain;
  std::vector<PairCounts> counts(blocks);
  const auto run = [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k)
      overlap_pair(packing, pairs[k], axes[k], out[k], counts[block]);
  };
  if (blocks < 2) {
    for (std::size_t block = 0; block < blocks; ++block) run(block);
  } else {
    // Isolated, so that a thread waiting here for the last pairs does not start another replicate meanwhile.
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, blocks, run); });
  }
  PairCounts sum;
  for (const PairCounts& block : counts) sum += block;
  return sum;
}

}  // namespace isojam
