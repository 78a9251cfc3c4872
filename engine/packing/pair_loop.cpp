#include "engine/packing/pair_loop.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <vector>

#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

/// Pairs handled as one task: some 50 µs, far more than a task costs, few enough to share out.
constexpr std::size_t grain = 128;

void overlap_pair(const Packing& packing, Precision precision, std::span<const PlacedSolid> placed,
                  const NeighbourPair& pair, SeparatingAxis& axis, Overlap& out, PairCounts& counts) {
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
  out = precision == Precision::double_double ? overlap(a, b, displacement_double_double(packing, pair), axis)
                                              : overlap(a, b, r, axis);
  if (out.path == OverlapPath::clip) ++counts.clipped;
  if (out.touching()) ++counts.touching;
  // No face separates: an edge pair does, and it is worth a search once.
  if (!out.touching() && axis.kind == SeparatingAxis::Kind::none) axis = best_axis(a, b, r);
}

void probe_pair(const Packing& packing, std::span<const PlacedSolid> placed, const NeighbourPair& pair,
                const SeparatingAxis& axis, double probe_distance, Overlap& out) {
  const PlacedSolid &a = placed[pair.a], &b = placed[pair.b];
  const Eigen::Vector3d r = displacement(packing, pair);
  const double length = r.norm(), reach = 2 * packing.solid->circumradius();
  out = {};
  if (length - probe_distance >= reach || length <= probe_distance) return;
  const Eigen::Vector3d closer = (1 - probe_distance / length) * r;
  if (separates(a, b, closer, axis)) return;
  SeparatingAxis unused;
  out = overlap(a, b, closer, unused);
}

/// Runs `run(block)` for every block of `grain` pairs.
template <class Run>
void for_each_block(std::size_t blocks, const Run& run) {
  if (blocks < 2) {
    for (std::size_t block = 0; block < blocks; ++block) run(block);
  } else {
    for_each_index(blocks, std::cref(run));
  }
}

std::size_t block_count(std::size_t pairs) { return (pairs + grain - 1) / grain; }

/// Second derivatives of the energy, ½ (g gᵀ + V H(V)), g = ∇V; θ → R·θ in rows and columns.
void pair_hessian(const Packing& packing, Precision precision, std::span<const PlacedSolid> placed,
                  const NeighbourPair& pair, PairHessian& out) {
  const PlacedSolid &a = placed[pair.a], &b = placed[pair.b];
  const Eigen::Vector3d r = displacement(packing, pair);
  SeparatingAxis unused;
  OverlapHessian h;
  const Overlap value = precision == Precision::double_double
                            ? overlap_with_hessian(a, b, displacement_double_double(packing, pair), unused, h)
                            : overlap_with_hessian(a, b, r, unused, h);
  out = pair_energy(value, h, r, packing.solid->gyration_radius()).hessian;
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

void for_each_slot(std::size_t slots, const std::function<void(std::size_t)>& run) {
  for_each_block(block_count(slots), [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(slots, (block + 1) * grain); ++k) run(k);
  });
}

void place_all(const Packing& packing, Precision precision, std::vector<PlacedSolid>& placed) {
  placed.resize(packing.poses.size());
  for_each_slot(placed.size(), [&](std::size_t k) {
    const Pose& pose = packing.poses[k];
    // In place of the old one, which owns nothing: a copy would cost as much again.
    if (precision == Precision::double_double) {
      std::construct_at(&placed[k], *packing.solid, rotation_matrix(pose));
    } else {
      std::construct_at(&placed[k], *packing.solid, pose.orientation.toRotationMatrix());
    }
  });
}

PairCounts overlap_pairs(const Packing& packing, Precision precision, std::span<const PlacedSolid> placed,
                         std::span<const NeighbourPair> pairs, std::span<SeparatingAxis> axes, std::span<Overlap> out) {
  assert(axes.size() == pairs.size() && out.size() == pairs.size());
  const std::size_t n = pairs.size();
  const std::size_t blocks = block_count(n);
  std::vector<PairCounts> counts(blocks);
  for_each_block(blocks, [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k)
      overlap_pair(packing, precision, placed, pairs[k], axes[k], out[k], counts[block]);
  });
  PairCounts sum;
  for (const PairCounts& block : counts) sum += block;
  return sum;
}

void probe_pairs(const Packing& packing, std::span<const PlacedSolid> placed, std::span<const NeighbourPair> pairs,
                 std::span<const SeparatingAxis> axes, double probe_distance, std::span<Overlap> out) {
  assert(axes.size() == pairs.size() && out.size() == pairs.size());
  const std::size_t n = pairs.size();
  for_each_block(block_count(n), [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k)
      probe_pair(packing, placed, pairs[k], axes[k], probe_distance, out[k]);
  });
}

void pair_hessians(const Packing& packing, Precision precision, std::span<const PlacedSolid> placed,
                   std::span<const NeighbourPair> pairs, std::span<const Overlap> overlaps,
                   std::span<PairHessian> out) {
  assert(overlaps.size() == pairs.size() && out.size() == pairs.size());
  const std::size_t n = pairs.size();
  for_each_block(block_count(n), [&](std::size_t block) {
    for (std::size_t k = block * grain; k < std::min(n, (block + 1) * grain); ++k) {
      if (overlaps[k].touching()) pair_hessian(packing, precision, placed, pairs[k], out[k]);
    }
  });
}

}  // namespace isojam
