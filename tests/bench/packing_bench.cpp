// Time of one packing's evaluation, Hessian and factorisation, and of a whole minimisation by each method, N = 100.

#include <benchmark/benchmark.h>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {
namespace {

/// Octahedra in equilibrium well above jamming.
Packing compressed(int n) {
  RandomStream random{29, static_cast<std::uint64_t>(n)};
  Packing packing = random_packing(platonic(SolidKind::octahedron), n, 0.78, random);
  PackingEnergy energy;
  minimise(packing, energy, {});
  return packing;
}

void evaluation(benchmark::State& state) {
  const Packing packing = compressed(static_cast<int>(state.range(0)));
  PackingEnergy energy;
  for (auto _ : state) benchmark::DoNotOptimize(energy.evaluate(packing).energy);
}

void hessian(benchmark::State& state) {
  const Packing packing = compressed(static_cast<int>(state.range(0)));
  PackingEnergy energy;
  for (auto _ : state) benchmark::DoNotOptimize(energy.hessian(packing).diagonal.data());
}

void factorisation(benchmark::State& state) {
  const Packing packing = compressed(static_cast<int>(state.range(0)));
  const BlockMatrix matrix = PackingEnergy().hessian(packing);
  BlockCholesky factor;
  for (auto _ : state) benchmark::DoNotOptimize(factor.factorise(matrix, 1e-6));
}

/// To residual 1e-6 after a strain step from equilibrium.
void minimisation(benchmark::State& state) {
  const Packing start = strained_to(compressed(100), 0.77);
  MinimiseOptions options;
  options.method = static_cast<Method>(state.range(0));
  MinimiseSummary summary;
  for (auto _ : state) {
    Packing packing = start;
    PackingEnergy energy;
    summary = minimise(packing, energy, options);
  }
  state.SetLabel(std::string(to_string(options.method)) + ": " + std::string(to_string(summary.reason)));
  state.counters["evaluations"] = static_cast<double>(summary.evaluations);
  state.counters["residual"] = summary.residual;
}

BENCHMARK(evaluation)->Arg(100)->Arg(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(hessian)->Arg(100)->Arg(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(factorisation)->Arg(100)->Arg(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(minimisation)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace isojam
