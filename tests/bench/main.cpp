// Runs the benchmarks in random order, repetition by repetition, so that other load on the machine affects all of them
// equally. Options are those of Google Benchmark; ratios.py judges its JSON output.

#include <benchmark/benchmark.h>

#include <iterator>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  // The options of the command line follow these and override them.
  std::string defaults[] = {"--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=9",
                            "--benchmark_min_time=0.03", "--benchmark_display_aggregates_only=true"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& option : defaults) arguments.push_back(option.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
#if defined(__clang__)
  benchmark::AddCustomContext("compiler", "clang " __VERSION__);
#else
  benchmark::AddCustomContext("compiler", "g++ " __VERSION__);
#endif
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  return benchmark::RunSpecifiedBenchmarks() == 0 ? 2 : 0;
}
