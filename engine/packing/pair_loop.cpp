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

RelativePose pose_of(const Packing& packing, const NeighbourPair& pair, const Eigen::Vector3d& d) {
  return relative_pose(packing.poses[static_cast<std::size_t>(pair.a)].orientation,
                       packing.poses[static_cast<std::size_t>(pair.b)].orientation, d);
}

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
  const RelativePose pose = pose_of(packing, pair, d);
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

/// Both diagonal 3×3 blocks Q, the second divided by R: A's frame and θ → lab frame and R·θ.
Matrix6d to_lab(const Matrix6d& h, const Eigen::Matrix3d& q, double radius) {
  Matrix6d frame = Matrix6d::Zero();
  frame.topLeftCorner<3, 3>() = q;
  frame.bottomRightCorner<3, 3>() = q / radius;
  return frame * h * frame.transpose();
}

void pair_hessian(const Packing& packing, const NeighbourPair& pair, const Overlap& overlap, PairHessian& out) {
  const ConvexSolid& solid = *packing.solid;
  const Eigen::Vector3d d = displacement(packing, pair);
  const RelativePose pose = pose_of(packing, pair, d);
  const Eigen::Vector3d& r = pose.displacement;
  const Matrix6d cross = overlap_cross_hessian(solid, solid, pose);
  const Vector6d ga = joined(overlap.area, overlap.moment);
  const Vector6d gb = joined(-overlap.area, r.cross(overlap.area) - overlap.moment);
  const Matrix6d own_a = overlap_own_hessian(cross, overlap.area, r);
  const Matrix6d own_b = overlap_own_hessian(cross.transpose(), -overlap.area, -r);
  const Eigen::Matrix3d q = packing.poses[static_cast<std::size_t>(pair.a)].orientation.toRotationMatrix();
  const double radius = solid.gyration_radius();
  out.aa = to_lab((ga * ga.transpose() + overlap.volume * own_a) / 2, q, radius);
  out.ab = to_lab((ga * gb.transpose() + overlap.volume * cross) / 2, q, radius);
  out.bb = to_lab((gb * gb.transpose() + overlap.volume * own_b) / 2, q, radius);
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
  const std::size_t blocks = block_count(n);
  std::vector<PairCounts> counts(blocks);
  for_each_block(blocks, [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k)
      overlap_pair(packing, pairs[k], axes[k], out[k], counts[block]);
  });
  PairCounts sum;
  for (const PairCounts& block : counts) sum += block;
  return sum;
}

void pair_hessians(const Packing& packing, std::span<const NeighbourPair> pairs, std::span<const Overlap> overlaps,
                   std::span<PairHessian> out) {
  assert(overlaps.size() == pairs.size() && out.size() == pairs.size());
  const std::size_t n = pairs.size();
  for_each_block(block_count(n), [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k) {
      if (overlaps[k].touching()) pair_hessian(packing, pairs[k], overlaps[k], out[k]);
    }
  });
}

}  // namespace isojam
