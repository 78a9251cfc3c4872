#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <tuple>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/interrupt.hpp"
#include "tasks/io/memory.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/texts.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/manifest/shard.hpp"
#include "tasks/records/failure_text.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/survey.hpp"
#include "tasks/records/texts.hpp"
#include "tasks/run/campaign.hpp"
#include "tasks/run/graph.hpp"
#include "tasks/tables/table_of.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

/// Arguments of `run` and of its dry run.
struct RunArguments {
  std::string manifest;
  std::string directory;  ///< results directory; empty means results/<name of the manifest>
  int threads = 0;        ///< number of threads; 0 means all threads that the system allows this process
  double memory_gib = 0;  ///< memory (GiB) for all replicates that run at the same time; 0 means all available memory
  Shard shard;
  bool dry_run = false;
};

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

/// Prints a line for every sweep point: the number of replicates, how many of them are recorded, and the estimated CPU
/// time of a replicate. Then prints estimates for the remaining replicates: their time and disk space, and the memory
/// of the replicate that needs the most memory. If there are records, the estimated times are scaled to the times in
/// these records. The function writes no file.
ExitCode dry_run(const Manifest& manifest, const Plan& plan, const std::string& directory,
                 const RunArguments& arguments) {
  const auto surveys = surveys_of(directory, {plan});
  const auto& survey = surveys.of_plans.front();
  const int threads = arguments.threads > 0 ? arguments.threads : default_threads();
  double least = 0, most = 0, disk = 0, disk_with_paths = 0, largest = 0;
  std::string text = fmt::format("{}: {}, seed {}, results in {}\n", manifest.name,
                                 counted(plan.points(), "sweep point"), manifest.seed, directory);
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto spec = plan.at(point, 0);
    const auto cost = estimated_cost(spec, manifest.keep_path);
    const double each = cost.cpu_seconds * survey.points[point].calibration;
    const auto& [recorded, taken] = std::tie(survey.points[point].recorded, survey.points[point].taken);
    const int at_least = std::max(0, manifest.replicates.min - recorded - taken);
    const int at_most = std::max(0, manifest.replicates.max - recorded - taken);
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

constexpr double gibibyte = 1024.0 * 1024 * 1024;

double work_of(const ReplicateSpec& spec) { return estimated_cost(spec, false).cpu_seconds; }

void report_outcome(const Outcome& outcome, Console& console) {
  const auto name = replicate_name(outcome.spec);
  console.finished(work_of(outcome.spec), outcome.failure.has_value());
  if (outcome.failure) {
    console.warn(fmt::format("{} failed: {}", name, failure_text(make_record(outcome))));
  } else {
    const auto& jam = outcome.jam;
    const auto density = jam.phi_j ? fmt::format("phi_j {:.6f}", jam.phi_j->density)
                                   : fmt::format("{} {:.6f}", jam.status == JamStatus::as_given ? "density" : "phi_0",
                                                 jam.states.front().density());
    console.detail(fmt::format("{}: {}, {} evaluations, {}", name, density, jam.evaluations,
                               duration_text(outcome.timing.wall_seconds)));
  }
  console.tick(name);
}

/// Stages of the engine that resume a replicate from its checkpoint, if it has one.
Stages resuming_stages(const Store& store) {
  auto stages = engine_stages();
  stages.begin = [&store, begin = stages.begin](const ReplicateSpec& spec) {
    auto checkpoint = store.checkpoint(spec);
    return checkpoint ? std::move(*checkpoint) : begin(spec);
  };
  return stages;
}

/// Runs a round, and returns the number of replicates that failed.
int run_round(Campaign& campaign, const Store& store, const Stages& stages, GraphOptions options, Console& console) {
  const auto size = campaign.round_size();
  const auto recorded = names_in(store.directory() / "records");
  console.begin(static_cast<int>(size.replicates - size.recorded), size.work);
  int failed = 0;
  options.on_step = [&](const ReplicateSpec& spec, const Checkpoint& checkpoint) {
    store.write_checkpoint(spec, checkpoint);
    console.tick(step_text(spec, checkpoint.progress));
  };
  const auto next = [&] {
    auto spec = campaign.next(options.stop);
    // The size of the round does not contain replicates whose record is not valid.
    if (spec && std::binary_search(recorded.begin(), recorded.end(), replicate_name(*spec)))
      console.add(work_of(*spec));
    return spec;
  };
  run_graph(next, stages, options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    store.write(outcome);
    failed += outcome.failure.has_value();
    report_outcome(outcome, console);
  });
  console.end();
  return failed;
}

/// Runs rounds until no replicate is left or a stop is requested.
ExitCode run_campaign(Campaign& campaign, const Store& store, const GraphOptions& options, Console& console) {
  const auto stages = resuming_stages(store);
  int failed = 0;
  for (int round = 0; campaign.open_round(); ++round) {
    // Print the message only if a replicate of this round will be computed.
    const auto size = campaign.round_size();
    if (round > 0 && size.replicates > size.recorded)
      console.info(fmt::format("confidence interval still too wide: running {}",
                               counted(size.replicates - size.recorded, "more replicate")));
    failed += run_round(campaign, store, stages, options, console);
    if (options.stop.stop_requested()) {
      console.warn(interrupted_run);
      return ExitCode::interrupted;
    }
  }
  return failed + campaign.failed() > 0 ? ExitCode::some_failed : ExitCode::done;
}

/// If replicates have no files, reports an error and returns false. has_files(name) is true if the files of this
/// replicate exist.
bool all_recorded(const Campaign& campaign, const std::function<bool(const std::string&)>& has_files,
                  Console& console) {
  const auto missing = campaign.without(has_files);
  if (missing.empty()) return true;
  console.error(fmt::format(
      "another process removed or changed files of {} during the run, for example of {}; repeat the command to "
      "recompute {}",
      counted(missing.size(), "replicate"), missing.front(), missing.size() == 1 ? "it" : "them"));
  return false;
}

/// Checks which replicates have a packing and, if the manifest keeps paths, a path.
class StateFiles {
 public:
  explicit StateFiles(const Store& store)
      : keep_path_(store.manifest().keep_path),
        packings_(names_of(store, "packings")),
        paths_(names_of(store, "paths")) {}

  bool has(const std::string& name) const { return packings_.contains(name) && (!keep_path_ || paths_.contains(name)); }
  static std::set<std::string> names_of(const Store& store, const char* folder) {
    const auto names = names_in(store.directory() / folder);
    return {names.begin(), names.end()};
  }

 private:
  bool keep_path_;
  std::set<std::string> packings_, paths_;
};

ExitCode finish_shard(const Campaign& campaign, const Store& store, const Shard& shard, ExitCode code,
                      Console& console) {
  const auto records = StateFiles::names_of(store, "records");
  const StateFiles files(store);
  const auto has_files = [&](const std::string& name) {
    if (!records.contains(name)) return false;
    // A failed replicate has only a record.
    return files.has(name) || read_record(store.directory(), name).summary.failed;
  };
  if (!all_recorded(campaign, has_files, console)) return ExitCode::some_failed;
  console.info(fmt::format("shard {}/{} is done; when all shards are done, run \"isojam aggregate {} -o {}\"",
                           shard.index + 1, shard.count, shell_argument(store.directory().string()),
                           shell_argument(store.tables_path().string())));
  return code;
}

/// Checks that no file was removed during the run, and writes and prints the tables. A shard makes no tables.
ExitCode finish(const Campaign& campaign, const Store& store, const Shard& shard, ExitCode code, Console& console) {
  if (!shard.whole()) return finish_shard(campaign, store, shard, code, console);
  const StateFiles files(store);
  std::set<std::string> complete;
  const auto table = table_of(
      store.directory().string(), store.manifest(), [&](const std::string& message) { console.warn(message); },
      [&](const RecordedReplicate& record) {
        if (record.summary.failed || files.has(record.name)) complete.insert(record.name);
      });
  if (!all_recorded(
          campaign, [&](const auto& name) { return complete.contains(name); }, console))
    return ExitCode::some_failed;
  store.write_tables(to_json(table));
  print_tables(table, store.directory().string());
  return code;
}

/// Validates the manifest, plans, runs the missing replicates, and prints the tables on standard output. A shard prints
/// no tables; `isojam aggregate` makes them after all shards have finished.
ExitCode run(const RunArguments& arguments, Console& console) {
  const InterruptWatcher watcher;
  const auto manifest = read_manifest(arguments.manifest);
  const auto directory = arguments.directory.empty() ? "results/" + manifest.name : arguments.directory;
  const Plan plan(manifest);
  warn_about(manifest, arguments.manifest, console);
  if (arguments.dry_run) {
    check_directory(directory, manifest, requests_in(directory, [&](const auto& message) { console.warn(message); }));
    return dry_run(manifest, plan, directory, arguments);
  }

  warn_without_fma(console);
  const Store store(directory, manifest, [&](const std::string& message) { console.warn(message); });
  Campaign campaign(plan, manifest.replicates, arguments.shard, store);
  const int threads = arguments.threads > 0 ? arguments.threads : default_threads();
  const double memory = arguments.memory_gib > 0 ? arguments.memory_gib * gibibyte : available_memory();
  GraphOptions options{threads, replicates_in_flight(threads, campaign.largest_memory(), memory), watcher.token(), {}};
  const auto checkpoints = names_in(store.directory() / "checkpoints").size();
  const auto& shard = arguments.shard;
  console.info(
      fmt::format("{}: {}{}{}, {} recorded{}, results in {}", manifest.name,
                  shard.whole() ? "" : fmt::format("shard {} of {}; whole study: ", shard.index + 1, shard.count),
                  manifest.replicates.goal ? "up to " : "", counted(plan.size(), "replicate"),
                  names_in(store.directory() / "records").size(),
                  checkpoints > 0 ? fmt::format(", {} unfinished", checkpoints) : "", directory));
  try {
    const auto code = run_campaign(campaign, store, options, console);
    return code == ExitCode::interrupted ? code : finish(campaign, store, arguments.shard, code, console);
  } catch (const FileError& error) {
    console.end();
    console.error(fmt::format("{}; {}", error.what(), how_to_resume));
    return ExitCode::some_failed;
  }
}

}  // namespace

void add_run(CLI::App& app, Session& session) {
  RunArguments* arguments = nullptr;
  auto options =
      add_command(app, session, "run", "Run the replicates of a manifest that have no record yet", run, arguments);
  options.text("manifest", arguments->manifest, "Manifest of the study (-: standard input)", "MANIFEST",
               Options::Need::required);
  options.text("-o,--output", arguments->directory,
               "Results directory (default: results/ and the name in the manifest)", "DIR");
  options.threads(arguments->threads);
  const auto read_shard = [arguments](const std::string& text) -> std::optional<std::string> {
    const auto shard = parse_shard(text);
    if (!shard) return "\"" + text + "\" is not accepted; expected I/N with integers I and N, where 1 ≤ I ≤ N ≤ 100000";
    arguments->shard = *shard;
    return std::nullopt;
  };
  options.parsed(
      "--shard", read_shard, [arguments] { arguments->shard = shard_of_environment(); },
      "Run part I of N of the study (default in a Slurm array of N tasks: the I-th task runs part I)", "I/N");
  options.positive(
      "--memory", arguments->memory_gib,
      "Run only as many replicates at the same time as fit into this memory, but at least one (default: the "
      "available memory)",
      "GIB");
  options.flag("--dry-run", arguments->dry_run, "Print the plan and its estimated cost, and run nothing");
}

}  // namespace isojam
