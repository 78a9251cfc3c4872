// Time that each minimiser needs to balance the forces after an affine strain step with N = 100. The step ends at a
// given Δφ. Near jamming only one method converges; the others stop at their largest number of evaluations.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include "engine/solve/minimise/minimise.hpp"
#include "tests/bench/states.hpp"

namespace isojam::bench {
namespace {

struct Case {
  std::string name;
  SolidKind kind;
  double distance;
};

void minimisation(benchmark::State& state, const Case& which, Method method, double residual) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const Packing& start = strained(which.kind, 100, which.distance);
  MinimiseOptions options;
  options.method = method;
  options.residual = residual;
  options.max_evaluations = method == Method::newton ? 20000 : 60000;
  MinimiseSummary summary;
  for (auto _ : state) {
    Packing packing = start;
    PackingEnergy energy;
    summary = minimise(packing, energy, options);
  }
  state.SetLabel(std::string(to_string(summary.reason)));
  state.counters["evaluations"] = static_cast<double>(summary.evaluations);
  state.counters["residual"] = summary.residual;
}

bool register_all() {
  const std::vector<Case> cases{{"octahedron_.03", SolidKind::octahedron, .03},
                                {"octahedron_.008", SolidKind::octahedron, .008},
                                {"tetrahedron_.033", SolidKind::tetrahedron, .033},
                                {"tetrahedron_.01", SolidKind::tetrahedron, .01}};
  const auto add = [](const std::string& name, const Case& which, Method method, double residual, int repetitions) {
    benchmark::RegisterBenchmark(name.c_str(), minimisation, which, method, residual)
        ->Iterations(1)
        ->Repetitions(repetitions);
  };
  for (const Case& which : cases) {
    add("minimise/newton/" + which.name, which, Method::newton, 1e-6, 5);
    add("minimise/newton_to_1e-9/" + which.name, which, Method::newton, 1e-9, 3);
    // Repeat the slow minimisers only once, because their times need not be accurate.
    if (which.name == "tetrahedron_.01") continue;
    for (const Method method : {Method::lbfgs, Method::fire, Method::conjugate_gradient})
      add("minimise/" + std::string(to_string(method)) + "/" + which.name, which, method, 1e-6, 1);
  }
  return true;
}

[[maybe_unused]] const bool registered = register_all();

}  // namespace
}  // namespace isojam::bench
