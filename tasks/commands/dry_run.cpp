#include "tasks/commands/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tasks/commands/shared.hpp"
#include "tasks/io/console.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/records/survey.hpp"
#include "tasks/records/texts.hpp"
#include "tasks/run/graph.hpp"

namespace isojam {
namespace {

std::string point_name(const ReplicateSpec& spec) {
  auto name = fmt::format("{} N={}", to_string(spec.solid), spec.particles);
  for (const auto& item : spec.parameters.items()) name += fmt::format(" {}={}", item.key(), item.value().dump());
  return name;
}

/// Text for the time left, which is between `least` and `most` > 0 seconds.
std::string left_text(double least, double most) {
  if (least == most) return about_text(most);
  return least < 0.5 ? fmt::format("up to {}", duration_text(std::max(most, 1.0)))
                     : fmt::format("{} to {}", about_text(least), duration_text(most));
}

}  // namespace

ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments) {
  const auto survey = survey_of(directory, plan, manifest.keep_path);
  if (!survey.others.empty())
    throw InputError({directory + "/records/" + survey.others.front() + ".json", "/provenance/manifest_digest",
                      std::string(other_manifest), "", "", std::string(choose_another_directory)});
  const int threads = arguments.threads > 0 ? arguments.threads : default_threads();
  double least = 0, most = 0, disk = 0, disk_with_paths = 0, largest = 0;
  std::string text = fmt::format("{}: {}, seed {}, results in {}\n", manifest.name,
                                 counted(plan.points(), "sweep point"), manifest.seed, directory);
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto spec = plan.at(point, 0);
    const auto cost = estimated_cost(spec, manifest.keep_path);
    const double each = cost.cpu_seconds * survey.points[point].calibration;
    const int recorded = survey.points[point].recorded;
    const int at_least = std::max(0, manifest.replicates.min - recorded);
    const int at_most = std::max(0, manifest.replicates.max - recorded);
    least += at_least * each, most += at_most * each;
    disk += at_most * cost.disk_bytes;
    disk_with_paths += at_most * estimated_cost(spec, true).disk_bytes;
    if (at_most > 0) largest = std::max(largest, cost.memory_bytes);
    const auto replicates = manifest.replicates.goal
                                ? fmt::format("{} to {} replicates", manifest.replicates.min, manifest.replicates.max)
                                : counted(static_cast<std::size_t>(manifest.replicates.max), "replicate");
    text += fmt::format("  {}: {}, {} recorded, {} of CPU time each\n", point_name(spec), replicates, recorded,
                        about_text(each));
  }
  if (manifest.replicates.goal)
    text += fmt::format("  until the 95 % confidence interval of {} is at most ± {:g}\n",
                        manifest.replicates.goal->quantity, manifest.replicates.goal->half_width);
  if (survey.lacking > 0)
    text += fmt::format(
        "  {} without measures that were added later; run \"isojam measure {}\" to add them, otherwise \"isojam run\" "
        "recomputes these replicates\n",
        counted(static_cast<std::size_t>(survey.lacking), "record"), directory);
  if (most == 0) {
    print(text + "remaining: nothing\n" + definitions_text(manifest));
    return ExitCode::done;
  }
  const int shards = arguments.shard.count;
  const double share = 1.0 / threads / shards;
  const auto with_paths =
      manifest.keep_path ? "" : fmt::format(" ({} with \"keep_path\": true)", bytes_text(disk_with_paths));
  text += fmt::format("remaining: {} on {}{}; at most {} on disk{}, about {} of memory per replicate\n",
                      left_text(least * share, most * share), counted(static_cast<std::size_t>(threads), "thread"),
                      shards > 1 ? fmt::format(" for each of {} shards", shards) : "", bytes_text(disk), with_paths,
                      bytes_text(largest));
  text += survey.calibration_records > 0
              ? fmt::format("(times estimated from {} of this directory)\n",
                            counted(static_cast<std::size_t>(survey.calibration_records), "record"))
              : "(times estimated from another machine; right within a factor of 1.5 for most studies)\n";
  print(text + definitions_text(manifest));
  return ExitCode::done;
}

}  // namespace isojam
