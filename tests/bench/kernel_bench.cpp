// Measures the time to compute one pair. For touching pairs, it compares the contact loop, with and without second
// derivatives, with other programs (peers) that compute the same pairs. It also measures the pairs of packings in their
// order, and the cached axis for pairs that almost touch. The solids are placed before the measurement, because a
// packing places them once per evaluation.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/extras/chart/pairs/intersection.hpp"
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

/// A pair, cut by one plane after another in doubles.
ClipPolytope<double> simply_clipped(const PairSet& set, std::size_t k) {
  Pose at_a, at_b;
  at_a.orientation = set.a(k).rotation(), at_b.orientation = set.b(k).rotation();
  at_b.position = set.r(k);
  return intersection<double>(set.a(k).solid(), at_a, set.b(k).solid(), at_b);
}

/// Checks that a method computes V, and S_A unless `area` is null, as simple clipping does. A comparison of times would
/// otherwise be meaningless.
template <class Volume>
void require_right(std::string_view method, const PairSet& set, std::size_t pairs, double tolerance,
                   const Volume& volume, const Eigen::Vector3d* area = nullptr) {
  for (std::size_t k = 0; k < pairs; ++k) {
    const auto body = simply_clipped(set, k);
    const auto s = body.area_and_moment(set.a(k).faces()).first;
    const double error = std::abs(volume(k) / body.volume() - 1);
    const Eigen::Vector3d right(s[0], s[1], s[2]);
    const double area_error = area == nullptr ? 0 : (*area - right).norm() / right.norm();
    if (error <= tolerance && area_error <= tolerance) continue;
    std::cerr << method << " and simple clipping differ by " << error << " of V and " << area_error << " of S\n";
    std::exit(EXIT_FAILURE);
  }
}

void contact_loop(benchmark::State& state, SolidKind kind) {
  const PairSet& set = touching_pairs(kind);
  Eigen::Vector3d area;
  const auto volume = [&](std::size_t k) {
    SeparatingAxis axis;
    const Overlap found = overlap(set.a(k), set.b(k), set.r(k), axis);
    area = found.area;
    return found.volume;
  };
  require_right("the contact loop", set, set.size(), 1e-9, volume, &area);
  time_pairs(state, set.size(), volume);
}

void in_packings(benchmark::State& state, SolidKind kind) {
  const PairSet& set = packing_pairs(kind);
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

void voropp(benchmark::State& state, SolidKind kind) {
  const PairSet& set = touching_pairs(kind);
  VoroCells cells(set);
  const auto volume = [&](std::size_t k) { return cells.overlap(k); };
  require_right("voro++", set, set.size(), 1e-9, volume, &cells.area());
  time_pairs(state, set.size(), volume);
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
  register_for_all_solids("overlap/in_packings", in_packings);
  register_for_all_solids("overlap/with_hessian", with_hessian);
  register_for_all_solids("overlap/voro++", voropp);
  register_for_all_solids("near_miss/cached_axis", cached_axis);
  return true;
}();

}  // namespace
}  // namespace isojam::bench
