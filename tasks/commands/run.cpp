#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "tasks/commands/command.hpp"
#include "tasks/commands/dry_run.hpp"
#include "tasks/commands/run.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/directory_lock.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/interrupt.hpp"
#include "tasks/io/memory.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/texts.hpp"
#include "tasks/run/campaign.hpp"
#include "tasks/run/graph.hpp"
#include "tasks/tables/table_of.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

constexpr double gibibyte = 1024.0 * 1024 * 1024;

/// Numbers of replicates in one round. A round contains the replicates that are started before the stopping rule is
/// checked again.
struct Tally {
  std::size_t given = 0, stored = 0;
  int failed = 0;
};

double work_of(const ReplicateSpec& spec) { return estimated_cost(spec, false).cpu_seconds; }

void report(const Outcome& outcome, Console& console) {
  const auto name = replicate_name(outcome.spec);
  console.finished(work_of(outcome.spec), outcome.failure.has_value());
  if (outcome.failure) {
    console.warn(fmt::format("{} failed in {}: {}", name, outcome.failure->where, outcome.failure->why));
  } else {
    console.detail(fmt::format("{}: phi_j {:.6f}, {} evaluations, {}", name, outcome.jam.phi_j->density,
                               outcome.jam.evaluations, duration_text(outcome.timing.wall_seconds)));
  }
  console.tick(name);
}

/// The stages of the engine, except that a replicate with a checkpoint resumes from it.
Stages resuming_stages(const Store& store) {
  auto stages = engine_stages();
  stages.begin = [&store, begin = stages.begin](const ReplicateSpec& spec) {
    auto checkpoint = store.checkpoint(spec);
    return checkpoint ? std::move(*checkpoint) : begin(spec);
  };
  return stages;
}

Tally run_round(Campaign& campaign, const Store& store, const Stages& stages, GraphOptions options, Console& console) {
  const auto size = campaign.round_size();
  console.begin(static_cast<int>(size.replicates - size.recorded), size.work);
  Tally tally;
  options.on_step = [&](const ReplicateSpec& spec, const Checkpoint& checkpoint) {
    store.write_checkpoint(spec, checkpoint);
    console.tick(step_text(spec, checkpoint.progress));
  };
  const NextReplicate next = [&] {
    auto spec = campaign.next();
    tally.given += spec.has_value();
    return spec;
  };
  run_graph(next, stages, options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    store.write(outcome);
    ++tally.stored;
    tally.failed += outcome.failure.has_value();
    report(outcome, console);
  });
  console.end();
  return tally;
}

/// Runs rounds until no replicate is left or a stop is requested.
ExitCode run_campaign(Campaign& campaign, const Store& store, const GraphOptions& options, Console& console) {
  const auto stages = resuming_stages(store);
  int failed = 0;
  for (int round = 0; campaign.open_round(); ++round) {
    // If all replicates of a round have records from earlier runs, print no message.
    const auto size = campaign.round_size();
    if (round > 0 && size.replicates > size.recorded)
      console.info(fmt::format("confidence interval still too wide: running {}",
                               counted(size.replicates - size.recorded, "more replicate")));
    const auto tally = run_round(campaign, store, stages, options, console);
    failed += tally.failed;
    if (options.stop.stop_requested()) {
      console.warn(interrupted_run);
      return ExitCode::interrupted;
    }
  }
  return failed + campaign.failed() > 0 ? ExitCode::some_failed : ExitCode::done;
}

/// True if all replicates of this run still have their files; otherwise reports an error. seen(name) is true if the
/// files of a replicate exist.
bool all_recorded(const Campaign& campaign, const std::function<bool(const std::string&)>& seen, Console& console) {
  const auto missing = campaign.without(seen);
  if (missing.empty()) return true;
  console.error(fmt::format(
      "files of {} were removed or changed during the run, the first is {}; repeat the command to recompute "
      "them",
      counted(missing.size(), "replicate"), missing.front()));
  return false;
}

ExitCode finish(const Campaign& campaign, const Store& store, const Shard& shard, ExitCode code, Console& console) {
  const auto directory = store.directory().string();
  std::set<std::string> whole;
  const auto names_of = [&](const char* folder) {
    const auto names = names_in(store.directory() / folder);
    return std::set<std::string>(names.begin(), names.end());
  };
  if (!shard.whole()) {
    whole = names_of("records");
    if (!all_recorded(
            campaign, [&](const auto& name) { return whole.contains(name); }, console))
      return ExitCode::some_failed;
    console.info(fmt::format("shard {}/{} is done; when all shards are done, run \"isojam aggregate {} -o {}\"",
                             shard.index + 1, shard.count, directory, store.tables_path().string()));
    return code;
  }
  const auto packings = names_of("packings"), paths = names_of("paths");
  const auto table = table_of(
      directory, store.kept(), [&](const std::string& message) { console.warn(message); },
      [&](const RecordedReplicate& held) {
        const bool kept = packings.contains(held.name) && (!store.kept().keep_path || paths.contains(held.name));
        if (held.summary.failed || kept) whole.insert(held.name);
      });
  if (!all_recorded(
          campaign, [&](const auto& name) { return whole.contains(name); }, console))
    return ExitCode::some_failed;
  store.write_tables(to_json(table));
  print(to_text(table));
  const bool failed = std::any_of(table.rows.begin(), table.rows.end(), [](const Row& row) { return row.failed > 0; });
  return failed ? ExitCode::some_failed : code;
}

/// If measures were added to the manifest of the directory, new replicates get these measures too.
void take_added_measures(const std::string& directory, Manifest& manifest, Console& console) {
  const auto kept = stored_manifest(directory);
  if (!kept || kept->measures == manifest.measures || !is_same_sweep(manifest, *kept)) return;
  if (with_measures(manifest, kept->measures).measures != kept->measures) return;
  manifest.measures = kept->measures;
  console.info(fmt::format("{}: new replicates also get the measures that were added to this directory", directory));
}

/// Validates the manifest, plans, runs the missing replicates, and prints the tables on standard output. A shard prints
/// no tables; `isojam aggregate` makes them after all shards have finished.
ExitCode run(const RunArguments& arguments, Console& console) {
  const InterruptWatcher watcher;
  auto manifest = read_manifest(arguments.manifest);
  load_start(manifest);
  const auto directory = arguments.directory.empty() ? "results/" + manifest.name : arguments.directory;
  take_added_measures(directory, manifest, console);
  const Plan plan(manifest);
  warn_about(manifest, arguments.manifest, console);
  const Warn warn = [&](const std::string& message) { console.warn(message); };
  if (arguments.dry_run) {
    check_directory(directory, manifest, warn);
    return dry_run(manifest, plan, directory, arguments);
  }

  warn_about_kernels(console);
  const Store store(directory, manifest, warn);
  const auto lock = DirectoryLock::take(directory, DirectoryLock::Kind::shared);
  if (!lock) throw FileError(in_use(directory), FileError::Reason::resource_failure);
  Campaign campaign(plan, manifest.replicates, arguments.shard, store);
  const int threads = arguments.threads > 0 ? arguments.threads : default_threads();
  const double memory = arguments.memory_gib > 0 ? arguments.memory_gib * gibibyte : available_memory();
  GraphOptions options{threads, replicates_in_flight(threads, campaign.largest_memory(), memory), watcher.token(), {}};
  const auto begun = names_in(store.directory() / "checkpoints").size();
  console.info(fmt::format(
      "{}: {}{}{}, {} recorded{}, results in {}", manifest.name, manifest.replicates.goal ? "up to " : "",
      counted(plan.size(), "replicate"),
      arguments.shard.whole() ? "" : fmt::format(", shard {}/{}", arguments.shard.index + 1, arguments.shard.count),
      names_in(store.directory() / "records").size(), begun > 0 ? fmt::format(", {} started", begun) : "", directory));
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
  auto options = add_command(app, session, "run", "Run the missing replicates of a manifest", run, arguments);
  options.text("manifest", arguments->manifest, "Manifest of the sweep (-: standard input)", "MANIFEST",
               Options::Need::required);
  options.text("-o,--output", arguments->directory, "Results directory (default: results/<name>)", "DIR");
  options.threads(arguments->threads);
  const auto read_shard = [arguments](const std::string& text) -> std::optional<std::string> {
    const auto shard = parse_shard(text);
    if (!shard) return "\"" + text + "\" is not accepted; expected I/N with integers 1 <= I <= N <= 100000";
    arguments->shard = *shard;
    return std::nullopt;
  };
  options.parsed(
      "--shard", read_shard, [arguments] { arguments->shard = shard_of_environment(); },
      "Run part I of N of the sweep (default in a Slurm array: the part of the task)", "I/N");
  options.positive("--memory", arguments->memory_gib,
                   "Limit the memory of the replicates that run at the same time (default: the available memory)",
                   "GIB");
  options.flag("--dry-run", arguments->dry_run, "Print the plan with its cost, and do nothing");
}

}  // namespace isojam
