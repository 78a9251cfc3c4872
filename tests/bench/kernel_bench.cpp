// Measures the time to compute one pair. For touching pairs, it compares the contact loop, with and without second
// derivatives, with clipping and with other programs (peers) that compute the same pairs. It also measures the pairs of
// packings in their order, and the cached axis for pairs that almost touch. For all methods, the solids are placed
// before the measurement, because a packing places them once per evaluation, not once per pair. Before a peer is timed,
// its volumes are compared with ours.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "tests/bench/pair_set.hpp"
#include "tests/bench/peers.hpp"

namespace isojam::bench {
namespace {

/// Times `work(k)` for all pairs, or for the first `pairs` of them if it is slow.
template <class Work>
void time_pairs(benchmark::State& state, std::size_t pairs, const Work& work) {
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(work(k));
    if (++k == pairs) k = 0;
  }
}

/// Checks that both methods compute the same volumes; otherwise a comparison of their times would be meaningless.
template <class Volume>
void require_equal_volumes(std::string_view peer, const PairSet& set, std::size_t pairs, double tolerance,
                           const Volume& volume) {
  const double worst = worst_difference(set, pairs, volume);
  if (worst <= tolerance) return;
  std::cerr << peer << " and the contact loop differ by " << worst << " of a volume, " << tolerance << " allowed\n";
  std::exit(EXIT_FAILURE);
}

void contact_loop(benchmark::State& state, SolidKind kind) {
  const PairSet& set = touching_pairs(kind);
  time_pairs(state, set.size(), [&](std::size_t k) {
    SeparatingAxis axis;
    return overlap(set.a(k), set.b(k), set.r(k), axis).volume;
  });
}

void in_packings(benchmark::State& state, SolidKind kind, int n) {
  const PairSet& set = packing_pairs(kind, n);
  time_pairs(state, set.size(), [&](std::size_t k) {
    SeparatingAxis axis;
    return overlap(set.a(k), set.b(k), set.r(k), axis).volume;
  });
}

void with_hessian(benchmark::State& state, SolidKind kind) {
  const PairSet& set = touching_pairs(kind);
  time_pairs(state, set.size(), [&](std::size_t k) {
    SeparatingAxis axis;
    OverlapHessian hessian;
    return overlap_with_hessian(set.a(k), set.b(k), set.r(k), axis, hessian).volume + hessian.bb(5, 5);
  });
}

void quadruple_clip(benchmark::State& state, SolidKind kind) {
  const PairSet& set = touching_pairs(kind);
  time_pairs(state, 64, [&](std::size_t k) {
    const Eigen::Matrix3d to_a = set.a(k).rotation().transpose();
    return clipped_overlap(set.a(k).solid(), set.b(k).solid(),
                           RelativePose{to_a * set.b(k).rotation(), to_a * set.r(k)})
        .volume;
  });
}

void voropp(benchmark::State& state, SolidKind kind) {
  const PairSet& set = touching_pairs(kind);
  VoroCells cells(set);
  const auto volume = [&](std::size_t k) { return cells.overlap(k); };
  require_equal_volumes("voro++", set, set.size(), 1e-9, volume);
  const double worst = worst_area_difference(set, [&](std::size_t k) { return (cells.overlap(k), cells.area()); });
  if (!(worst <= 1e-9)) {
    std::cerr << "voro++ and the contact loop differ by " << worst << " of a vector area\n";
    std::exit(EXIT_FAILURE);
  }
  time_pairs(state, set.size(), volume);
}

void cgal(benchmark::State& state, SolidKind kind) {
  constexpr std::size_t pairs = 256;
  const PairSet& set = touching_pairs(kind);
  const auto volume = [&](std::size_t k) { return cgal_overlap(set, k); };
  require_equal_volumes("CGAL", set, pairs, 1e-6, volume);
  time_pairs(state, pairs, volume);
}

void cached_axis(benchmark::State& state, SolidKind kind) {
  const PairSet& set = separated_pairs(kind);
  std::vector<SeparatingAxis> axes;
  for (std::size_t k = 0; k < set.size(); ++k) axes.push_back(best_axis(set.a(k), set.b(k), set.r(k)));
  time_pairs(state, set.size(), [&](std::size_t k) { return separates(set.a(k), set.b(k), set.r(k), axes[k]); });
}

void register_for_all_solids(const std::string& family_and_method, void (*run)(benchmark::State&, SolidKind)) {
  for (const SolidKind kind : all_solids) {
    const std::string name = family_and_method + "/" + std::string(to_string(kind));
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { run(state, kind); });
  }
}

[[maybe_unused]] const bool registered = [] {
  register_for_all_solids("overlap/contact_loop", contact_loop);
  for (const int n : {64, 1000, 10000}) {
    for (const SolidKind kind : all_solids) {
      const std::string name = "overlap/in_packings_N=" + std::to_string(n) + "/" + std::string(to_string(kind));
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { in_packings(state, kind, n); });
    }
  }
  register_for_all_solids("overlap/with_hessian", with_hessian);
  register_for_all_solids("overlap/quadruple_clip", quadruple_clip);
  register_for_all_solids("overlap/voro++", voropp);
  register_for_all_solids("overlap/cgal", cgal);
  register_for_all_solids("near_miss/cached_axis", cached_axis);
  return true;
}();

}  // namespace
}  // namespace isojam::bench
