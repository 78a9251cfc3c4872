// Time of whole replicates on one core, from φ = 0.05 to Δφ ≤ 0.004 (0.01 for tetrahedra). Also the time to compute the
// lowest and highest modes of a packing in equilibrium.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include "engine/solve/jam.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tests/bench/states.hpp"

namespace isojam::bench {
namespace {

void replicate(benchmark::State& state, SolidKind kind, int n) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  JamOptions options;
  options.decompression.final_distance = .004;
  if (kind == SolidKind::tetrahedron) {  // as by default in a manifest, but not as near to jamming
    options.compression.step = .02, options.compression.evaluations = 2000;
    options.decompression.final_distance = .01;
  }
  std::uint64_t number = 0;
  double overlaps = 0;
  JamResult result;
  for (auto _ : state) {
    RandomStream random{31, static_cast<std::uint64_t>(kind), static_cast<std::uint64_t>(n), number++};
    result = jam(random_packing(platonic(kind), n, options.compression.initial_density, random), options);
    overlaps += static_cast<double>(result.counts.overlapped);
  }
  state.SetLabel(std::string(to_string(result.status)));
  if (result.status != JamStatus::jammed) state.SkipWithError("did not reach the distance asked for");
  state.counters["seconds_per_overlap"] = seconds_per(overlaps);
}

void modes(benchmark::State& state, int n) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const BlockMatrix hessian = PackingEnergy().hessian(jammed(SolidKind::octahedron, n, .03));
  SpectrumEnds ends;
  for (auto _ : state) ends = spectrum_ends(hessian);
  state.SetLabel(std::string(to_string(ends.lowest.ended)) + ", " + std::string(to_string(ends.highest.ended)));
}

bool register_all() {
  const auto add = [](SolidKind kind, int n, int repetitions) {
    const std::string name = "replicate/jam/" + std::string(to_string(kind)) + "_N=" + std::to_string(n);
    benchmark::RegisterBenchmark(name.c_str(), replicate, kind, n)->Iterations(1)->Repetitions(repetitions);
  };
  for (const SolidKind kind :
       {SolidKind::tetrahedron, SolidKind::octahedron, SolidKind::dodecahedron, SolidKind::icosahedron})
    add(kind, 100, 3);
  add(SolidKind::octahedron, 400, 1);
  add(SolidKind::dodecahedron, 400, 1);
  benchmark::RegisterBenchmark("modes/both_ends/N=400", modes, 400)->Repetitions(3);
  return true;
}

[[maybe_unused]] const bool registered = register_all();

}  // namespace
}  // namespace isojam::bench
