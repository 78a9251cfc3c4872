// Throughput of a study of small replicates, on one core and on two. Records and checkpoints are written. The time is
// wall-clock time, because a user waits for it.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>

namespace {

constexpr auto study = R"({"name": "throughput", "seed": 3, "sweep": {"solid": ["dodecahedron"], "particles": [40]},
                           "replicates": 16, "protocol": {"final_distance": 0.01}})";

void sweep(benchmark::State& state, int threads) {
  const std::string command = "d=$(mktemp -d) && echo '" + std::string(study) +
                              "' >$d/study.json && " ISOJAM_PROGRAM " --quiet run $d/study.json -o $d/results -j " +
                              std::to_string(threads) + " >/dev/null; code=$?; rm -rf $d; exit $code";
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) return state.SkipWithError("the study failed");
}

[[maybe_unused]] const bool registered = [] {
  for (const int threads : {1, 2}) {
    const std::string name = "sweep/" + std::to_string(threads) + (threads == 1 ? "_thread" : "_threads") + "/N=40";
    benchmark::RegisterBenchmark(name.c_str(), sweep, threads)->Iterations(1)->Repetitions(5)->UseRealTime();
  }
  return true;
}();

}  // namespace
