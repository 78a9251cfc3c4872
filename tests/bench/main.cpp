// isojam_bench [--ratios FILE] [Google Benchmark's options]
// Runs the benchmarks in random order, repetition by repetition, so that other load on the machine affects all of them
// equally. Prints medians and the table of ratios, and writes both as JSON if a file is given.

#include <algorithm>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>

#include "tests/bench/reporter.hpp"

namespace {

/// Removes `--ratios FILE` from the arguments and returns FILE. Returns an empty text if the option is missing.
std::string take_ratios_path(std::vector<char*>& arguments) {
  const auto flag = std::find_if(arguments.begin(), arguments.end(),
                                 [](const char* text) { return std::strcmp(text, "--ratios") == 0; });
  if (flag == arguments.end() || flag + 1 == arguments.end()) return "";
  std::string path = flag[1];
  arguments.erase(flag, flag + 2);
  return path;
}

int run(int argc, char** argv) {
  // The options of the command line follow these and override them.
  std::string defaults[] = {"--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=9",
                            "--benchmark_min_time=0.03"};
  std::vector<char*> arguments;
  arguments.reserve(static_cast<std::size_t>(argc) + std::size(defaults) + 1);
  arguments.push_back(argv[0]);
  for (std::string& option : defaults) arguments.push_back(option.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  const std::string path = take_ratios_path(arguments);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  isojam::bench::MedianReporter reporter;
  if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) return 2;
  const auto verdicts = isojam::bench::judge(isojam::bench::all_claims(), reporter.medians());
  std::cout << reporter.machine().dump() << "\n\n";
  print_medians(std::cout, reporter);
  std::cout << '\n';
  print_verdicts(std::cout, verdicts);
  if (!path.empty()) {
    std::ofstream file(path);
    file << to_json(reporter, verdicts).dump(2) << '\n';
    if (!file.flush()) {
      std::cerr << "cannot write " << path << '\n';
      return 2;
    }
  }
  return reporter.failed() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) try { return run(argc, argv); } catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
