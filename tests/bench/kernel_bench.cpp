// Time of one pair: the contact loop on touching pairs, the slow clip on the same pairs, the cached axis on near
// misses. Pairs are many and differ, so that the branch predictor cannot learn them.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "engine/geometry/overlap.hpp"
#include "engine/random/stream.hpp"

namespace isojam {
namespace {

Eigen::Quaterniond random_orientation(RandomStream& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

/// Random pairs: touching with V/V_p in 1e-5 … 3e-2, or apart though their circumspheres meet.
std::vector<RelativePose> random_pairs(const ConvexSolid& solid, bool touching) {
  constexpr std::size_t pairs = 4096;
  RandomStream random{17, hash_text(solid.name().data(), solid.name().data() + solid.name().size())};
  std::vector<RelativePose> poses;
  while (poses.size() < pairs) {
    const Eigen::Quaterniond a = random_orientation(random), b = random_orientation(random);
    const Eigen::Vector3d direction = random_orientation(random) * Eigen::Vector3d::UnitX();
    const double distance = 2 * (solid.inradius() + (solid.circumradius() - solid.inradius()) * random.uniform());
    const RelativePose pose = relative_pose(a, b, distance * direction);
    const double volume = overlap(solid, solid, pose).volume;
    if (touching ? volume > 1e-5 && volume < 3e-2 : volume == 0) poses.push_back(pose);
  }
  return poses;
}

const ConvexSolid& solid_of(const benchmark::State& state) { return platonic(all_solids[state.range(0)]); }

void contact_loop(benchmark::State& state) {
  const ConvexSolid& solid = solid_of(state);
  const std::vector<RelativePose> poses = random_pairs(solid, true);
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(overlap(solid, solid, poses[k++ % poses.size()]).volume);
  state.SetLabel(solid.name());
}

void quadruple_clip(benchmark::State& state) {
  const ConvexSolid& solid = solid_of(state);
  const std::vector<RelativePose> poses = random_pairs(solid, true);
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(clipped_overlap(solid, solid, poses[k++ % poses.size()]).volume);
  state.SetLabel(solid.name());
}

void cached_axis(benchmark::State& state) {
  const ConvexSolid& solid = solid_of(state);
  const std::vector<RelativePose> poses = random_pairs(solid, false);
  std::vector<SeparatingAxis> axes;
  for (const RelativePose& pose : poses) axes.push_back(best_axis(solid, solid, pose));
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(gap(solid, solid, poses[k % poses.size()], axes[k % poses.size()]));
    ++k;
  }
  state.SetLabel(solid.name());
}

BENCHMARK(contact_loop)->DenseRange(0, 4);
BENCHMARK(quadruple_clip)->DenseRange(0, 4);
BENCHMARK(cached_axis)->DenseRange(0, 4);

}  // namespace
}  // namespace isojam
