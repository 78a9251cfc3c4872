#include "engine/packing/pair_loop.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

/// Number of pairs in a block, which one task processes.
constexpr std::size_t grain = small_calls_per_task;

/// A pair that may touch. The vector is stored as three scalars: a packed load of two doubles would stall on store
/// forwarding.
struct NearPair {
  std::size_t pair;
  double x, y, z;  ///< x_B − x_A

  Eigen::Vector3d r() const { return {x, y, z}; }
};
using NearPairs = std::array<NearPair, grain>;

/// Selects the pairs from first to last − 1 whose circumscribed spheres intersect, and returns their number. A branch
/// would be unpredictable here and in not_separated(). Both functions therefore write every pair, and increase the
/// counter only for a pair that they keep.
template <class Reach>
std::size_t within_reach(const Packing& packing, std::span<const NeighbourPair> pairs, std::size_t first,
                         std::size_t last, const Reach& reach_of, NearPairs& near) {
  std::size_t count = 0;
  for (std::size_t k = first; k < last; ++k) {
    const double reach = reach_of(pairs[k]);
    const Eigen::Vector3d r = displacement(packing, pairs[k]);
    near[count] = {k, r.x(), r.y(), r.z()};
    count += static_cast<std::size_t>(r.squaredNorm() < reach * reach);
  }
  return count;
}

double reach_of(const Composition& solids, const NeighbourPair& pair) {
  return solids[pair.a].circumradius() + solids[pair.b].circumradius();
}

std::size_t within_reach(const Packing& packing, std::span<const NeighbourPair> pairs, std::size_t first,
                         std::size_t last, NearPairs& near) {
  const Composition& solids = packing.solids;
  if (!solids.is_uniform())
    return within_reach(
        packing, pairs, first, last, [&](const NeighbourPair& pair) { return reach_of(solids, pair); }, near);
  const double reach = 2 * solids.only().circumradius();
  return within_reach(
      packing, pairs, first, last, [reach](const NeighbourPair&) { return reach; }, near);
}

/// Keeps only the pairs that their stored axes do not separate, and returns their number.
std::size_t not_separated(const PlacedSolids& placed, std::span<const NeighbourPair> pairs,
                          std::span<const SeparatingAxis> axes, std::size_t count, NearPairs& near) {
  std::size_t left = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place = near[k].pair;
    const Eigen::Vector3d r = near[k].r();
    near[left] = near[k];
    left += static_cast<std::size_t>(!separates(placed[pairs[place].a], placed[pairs[place].b], r, axes[place]));
  }
  return left;
}

/// The overlap of a pair that its stored axis does not separate. The axis is updated.
Overlap overlap_unseparated(const Packing& packing, Precision precision, const PlacedSolids& placed,
                            const NeighbourPair& pair, const Eigen::Vector3d& r, SeparatingAxis& axis) {
  const PlacedSolid a = placed[pair.a], b = placed[pair.b];
  Overlap found = precision == Precision::double_double ? overlap(a, b, displacement_double_double(packing, pair), axis)
                                                        : overlap(a, b, r, axis);
  // If the solids are separate but no face separates them, the product of two edges does. Later evaluations reuse this
  // axis, so one search for it reduces the total time.
  if (!found.touching() && axis.kind == SeparatingAxis::Kind::none) axis = best_axis(a, b, r);
  return found;
}

PairCounts overlap_block(const Packing& packing, Precision precision, const PlacedSolids& placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, std::size_t first,
                         std::size_t last, std::vector<PairOverlap>& touching) {
  NearPairs near;
  const std::size_t reachable = within_reach(packing, pairs, first, last, near);
  const std::size_t left = not_separated(placed, pairs, axes, reachable, near);
  PairCounts counts;
  counts.listed = static_cast<long>(last - first);
  counts.out_of_reach = counts.listed - static_cast<long>(reachable);
  counts.by_axis = static_cast<long>(reachable - left);
  counts.overlapped = static_cast<long>(left);
  touching.clear();
  for (std::size_t k = 0; k < left; ++k) {
    const std::size_t place = near[k].pair;
    const Overlap found = overlap_unseparated(packing, precision, placed, pairs[place], near[k].r(), axes[place]);
    counts.clipped += static_cast<long>(found.path == OverlapPath::clip);
    if (found.touching()) touching.push_back({place, found});
  }
  counts.touching = static_cast<long>(touching.size());
  return counts;
}

void probe_pair(const Packing& packing, const PlacedSolids& placed, std::span<const NeighbourPair> pairs,
                std::span<const SeparatingAxis> axes, std::size_t k, double probe_distance,
                std::vector<PairOverlap>& touching) {
  const Eigen::Vector3d r = displacement(packing, pairs[k]);
  const double length = r.norm(), reach = reach_of(packing.solids, pairs[k]);
  if (length - probe_distance >= reach || length <= probe_distance) return;
  const PlacedSolid a = placed[pairs[k].a], b = placed[pairs[k].b];
  const Eigen::Vector3d closer = (1 - probe_distance / length) * r;
  if (separates(a, b, closer, axes[k])) return;
  SeparatingAxis unused;
  const Overlap found = overlap(a, b, closer, unused);
  if (found.touching()) touching.push_back({k, found});
}

std::size_t block_count(std::size_t pairs) { return (pairs + grain - 1) / grain; }

Overlap overlap_with_hessian(const Packing& packing, Precision precision, const PlacedSolids& placed,
                             const NeighbourPair& pair, OverlapHessian& h) {
  const PlacedSolid a = placed[pair.a], b = placed[pair.b];
  SeparatingAxis unused;
  return precision == Precision::double_double
             ? isojam::overlap_with_hessian(a, b, displacement_double_double(packing, pair), unused, h)
             : isojam::overlap_with_hessian(a, b, displacement(packing, pair), unused, h);
}

/// The results of hessian_of(pair) for every touching pair, in the order of `touching`.
template <class HessianOf>
std::vector<PairHessian> for_touching(std::span<const NeighbourPair> pairs, const TouchingPairs& touching,
                                      const HessianOf& hessian_of) {
  std::vector<std::size_t> first{0};
  for (const auto& block : touching.blocks) first.push_back(first.back() + block.size());
  std::vector<PairHessian> hessians(first.back());
  for_each_index(touching.blocks.size(), [&](std::size_t block) {
    for (std::size_t k = 0; k < touching.blocks[block].size(); ++k)
      hessians[first[block] + k] = hessian_of(pairs[touching.blocks[block][k].pair]);
  });
  return hessians;
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

Overlap overlap_listed(const Packing& packing, const PlacedSolids& placed, const NeighbourPair& pair,
                       SeparatingAxis& axis) {
  const Eigen::Vector3d r = displacement(packing, pair);
  const double reach = reach_of(packing.solids, pair);
  if (r.squaredNorm() >= reach * reach || separates(placed[pair.a], placed[pair.b], r, axis)) return {};
  return overlap_unseparated(packing, Precision::working, placed, pair, r, axis);
}

void make_room(const Packing& packing, Precision precision, PlacedSolids& placed) {
  const bool low = precision == Precision::double_double;
  if (packing.solids.is_uniform()) {
    placed.resize(packing.solids.only(), packing.poses.size(), low);
  } else {
    placed.resize(packing.solids.solids(), low);
  }
}

void place_all(const Packing& packing, Precision precision, PlacedSolids& placed) {
  make_room(packing, precision, placed);
  for_each_small(placed.size(), [&](std::size_t k) {
    const Pose& pose = packing.poses[k];
    if (precision == Precision::double_double) {
      placed.place(k, rotation_matrix(pose));
    } else {
      placed.place(k, pose.orientation.toRotationMatrix());
    }
  });
}

PairCounts overlap_pairs(const Packing& packing, Precision precision, const PlacedSolids& placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes,
                         TouchingPairs& touching) {
  assert(axes.size() == pairs.size());
  const std::size_t n = pairs.size(), blocks = block_count(n);
  std::vector<PairCounts> counts(blocks);
  touching.blocks.resize(blocks);
  for_each_index(blocks, [&](std::size_t block) {
    counts[block] = overlap_block(packing, precision, placed, pairs, axes, block * grain,
                                  std::min(n, (block + 1) * grain), touching.blocks[block]);
  });
  PairCounts sum;
  for (const PairCounts& block : counts) sum += block;
  return sum;
}

TouchingPairs probe_pairs(const Packing& packing, const PlacedSolids& placed, std::span<const NeighbourPair> pairs,
                          std::span<const SeparatingAxis> axes, double probe_distance) {
  assert(axes.size() == pairs.size());
  const std::size_t n = pairs.size();
  TouchingPairs touching;
  touching.blocks.resize(block_count(n));
  for_each_index(touching.blocks.size(), [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k)
      probe_pair(packing, placed, pairs, axes, k, probe_distance, touching.blocks[block]);
  });
  return touching;
}

std::vector<PairHessian> pair_hessians(const Packing& packing, Precision precision, const PlacedSolids& placed,
                                       std::span<const NeighbourPair> pairs, const TouchingPairs& touching) {
  return for_touching(pairs, touching, [&](const NeighbourPair& pair) {
    OverlapHessian h;
    const Overlap value = overlap_with_hessian(packing, precision, placed, pair, h);
    return pair_energy(value, h, displacement(packing, pair), packing.solids[pair.a].gyration_radius(),
                       packing.solids[pair.b].gyration_radius())
        .hessian;
  });
}

std::vector<PairHessian> volume_hessians(const Packing& packing, Precision precision, const PlacedSolids& placed,
                                         std::span<const NeighbourPair> pairs, const TouchingPairs& touching,
                                         const Composition& solids) {
  return for_touching(pairs, touching, [&](const NeighbourPair& pair) {
    OverlapHessian h;
    overlap_with_hessian(packing, precision, placed, pair, h);
    return volume_hessian(h, solids[pair.a].gyration_radius(), solids[pair.b].gyration_radius());
  });
}

}  // namespace isojam
