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

/// Of the energy, ½ (g gᵀ + V H(V)), g = ∇V; θ → R·θ in rows and columns.
PairHessian energy_hessian(const Overlap& overlap, const OverlapHessian& h, const Eigen::Vector3d& r, double radius) {
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(1 / radius);
  const Vector6d ga = joined(overlap.area, overlap.moment);
  const Vector6d gb = joined(-overlap.area, r.cross(overlap.area) - overlap.moment);
  const auto block = [&](const Vector6d& g, const Vector6d& k, const Matrix6d& second) -> Matrix6d {
    return scale.asDiagonal() * ((g * k.transpose() + overlap.volume * second) / 2) * scale.asDiagonal();
  };
  return {block(ga, ga, h.aa), block(ga, gb, h.ab), block(gb, gb, h.bb)};
}

/// `hessian` may be null.
void overlap_pair(const Packing& packing, std::span<const PlacedSolid> placed, const NeighbourPair& pair,
                  SeparatingAxis& axis, Overlap& out, PairHessian* hessian, PairCounts& counts) {
  const PlacedSolid &a = placed[pair.a], &b = placed[pair.b];
  const Eigen::Vector3d r = displacement(packing, pair);
  ++counts.listed;
  out = {};
  const double reach = 2 * packing.solid->circumradius();
  if (r.squaredNorm() >= reach * reach) {
    ++counts.out_of_reach;
    return;
  }
  if (separates(a, b, r, axis)) {
    ++counts.by_axis;
    return;
  }
  ++counts.overlapped;
  if (hessian) {
    OverlapHessian second;
    out = overlap(a, b, r, axis, second);
    if (out.touching()) *hessian = energy_hessian(out, second, r, packing.solid->gyration_radius());
  } else {
    out = overlap(a, b, r, axis);
  }
  if (out.path == OverlapPath::clip) ++counts.clipped;
  if (out.touching()) ++counts.touching;
  // No face separates: an edge pair does, and it is worth a search once.
  if (!out.touching() && axis.kind == SeparatingAxis::Kind::none) axis = best_axis(a, b, r);
}

/// Runs `run(block)` for every block of `grain` pairs.
template <class Run>
void for_each_block(std::size_t blocks, const Run& run) {
  if (blocks < 2) {
    for (std::size_t block = 0; block < blocks; ++block) run(block);
  } else {
    // Isolated, so that a thread waiting here for the last pairs does not start another replicate meanwhile.
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, blocks, run); });
  }
}

std::size_t block_count(std::size_t pairs) { return (pairs + grain - 1) / grain; }

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

void place_all(const Packing& packing, std::vector<PlacedSolid>& placed) {
  placed.clear();
  placed.reserve(packing.poses.size());
  for (const Pose& pose : packing.poses) placed.emplace_back(*packing.solid, pose.orientation.toRotationMatrix());
}

PairCounts overlap_pairs(const Packing& packing, std::span<const PlacedSolid> placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, std::span<Overlap> out,
                         std::span<PairHessian> hessians) {
  assert(axes.size() == pairs.size() && out.size() == pairs.size());
  assert(hessians.empty() || hessians.size() == pairs.size());
  const std::size_t n = pairs.size();
  const std::size_t blocks = block_count(n);
  std::vector<PairCounts> counts(blocks);
  for_each_block(blocks, [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k)
      overlap_pair(packing, placed, pairs[k], axes[k], out[k], hessians.empty() ? nullptr : &hessians[k],
                   counts[block]);
  });
  PairCounts sum;
  for (const PairCounts& block : counts) sum += block;
  return sum;
}

}  // namespace isojam
