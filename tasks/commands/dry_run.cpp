#include "tasks/commands/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tasks/commands/shared.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/run/graph.hpp"
#include "tasks/store/survey.hpp"
#include "tasks/system/console.hpp"
#include "tasks/system/standard_streams.hpp"

namespace isojam {
namespace {

std::string point_name(const ReplicateSpec& spec) {
  auto name = fmt::format("{} N={}", to_string(spec.solid), spec.particles);
  for (const auto& item : spec.parameters.items()) name += fmt::format(" {}={}", item.key(), item.value().dump());
  return name;
}

}  // namespace

ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments) {
  const auto survey = survey_of(directory, plan, manifest.keep_path);
  const int threads = arguments.threads > 0 ? arguments.threads : default_threads();
  double least = 0, most = 0, disk = 0, largest = 0;
  std::string text = fmt::format("{}: {} sweep points, seed {}, results in {}\n", manifest.name, plan.points(),
                                 manifest.seed, directory);
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto spec = plan.at(point, 0);
    const auto cost = estimated_cost(spec, manifest.keep_path);
    const double each = cost.cpu_seconds * survey.calibration;
    const int recorded = survey.points[point].recorded;
    const int at_least = std::max(0, manifest.replicates.min - recorded);
    const int at_most = std::max(0, manifest.replicates.max - recorded);
    least += at_least * each, most += at_most * each;
    disk += at_most * cost.disk_bytes;
    largest = std::max(largest, cost.memory_bytes);
    const auto replicates = manifest.replicates.goal
                                ? fmt::format("{} to {}", manifest.replicates.min, manifest.replicates.max)
                                : std::to_string(manifest.replicates.max);
    text += fmt::format("  {}: {} replicates, {} recorded, about {} of CPU each\n", point_name(spec), replicates,
                        recorded, duration_text(each));
  }
  if (manifest.replicates.goal)
    text += fmt::format("  until the 95 % interval of {} is narrower than ± {:g}\n", manifest.replicates.goal->quantity,
                        manifest.replicates.goal->half_width);
  const int shards = arguments.shard.count;
  const auto time = [&](double cpu) { return duration_text(cpu / threads / shards); };
  text += fmt::format("left to do: about {}{} on {} threads{}; at most {} on disk, about {} of memory per replicate\n",
                      least < most ? time(least) + " to " : "", time(most), threads,
                      shards > 1 ? fmt::format(" for each of {} shards", shards) : "", bytes_text(disk),
                      bytes_text(largest));
  text += survey.calibration_records > 0
              ? fmt::format("(times from {} records here)\n", survey.calibration_records)
              : "(times from the machine isojam was measured on: right to a factor of two or so)\n";
  print(text);
  return ExitCode::done;
}

}  // namespace isojam
