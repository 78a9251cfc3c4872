// Throughput of a sweep of small replicates in the task graph, on one core and on two. Records and checkpoints are
// written. The time is wall-clock time, because a user waits for it.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "tasks/run/campaign.hpp"
#include "tasks/run/graph.hpp"

namespace isojam::bench {
namespace {

namespace fs = std::filesystem;

Manifest small_sweep() {
  return parse_manifest(R"({"name": "throughput", "seed": 3, "sweep": {"solid": ["dodecahedron"], "particles": [40]},
                            "replicates": 16, "protocol": {"final_distance": 0.01}})",
                        "throughput");
}

void run_once(const Manifest& manifest, const fs::path& directory, int threads) {
  const Plan plan(manifest);
  const Store store(directory, manifest, [](const std::string&) {});
  Campaign campaign(plan, manifest.replicates, {}, store);
  campaign.open_round();
  const GraphOptions options{threads, 0, {}, [&](const ReplicateSpec& spec, const Checkpoint& checkpoint) {
                               store.write_checkpoint(spec, checkpoint);
                             }};
  run_graph([&] { return campaign.next(); }, engine_stages(), options,
            [&](const Outcome& outcome) { store.write(outcome); });
}

void sweep(benchmark::State& state, int threads) {
  const auto manifest = small_sweep();
  for (auto _ : state) {
    state.PauseTiming();
    auto name = (fs::temp_directory_path() / "isojam-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) return state.SkipWithError("no temporary directory");
    state.ResumeTiming();
    run_once(manifest, name, threads);
    state.PauseTiming();
    fs::remove_all(name);
    state.ResumeTiming();
  }
  state.counters["replicates"] = manifest.replicates.max;
}

bool register_all() {
  for (const int threads : {1, 2}) {
    const std::string name = "sweep/" + std::to_string(threads) + (threads == 1 ? "_thread" : "_threads") + "/N=40";
    benchmark::RegisterBenchmark(name.c_str(), sweep, threads)->Iterations(1)->Repetitions(5)->UseRealTime();
  }
  return true;
}

[[maybe_unused]] const bool registered = register_all();

}  // namespace
}  // namespace isojam::bench
