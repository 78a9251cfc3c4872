#include <fmt/format.h>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/interrupt.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/records/store.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/run/graph.hpp"

namespace isojam {
namespace {

ReplicateSpec planned(const Requests& requests, const std::string& name, const Store& store) {
  for (const auto& plan : requests) {
    const auto place = plan.place_of(name);
    if (!place || !plan.requests(*place)) continue;
    auto manifest = plan.manifest();
    load_start(manifest);
    return Plan(manifest).at(place->point, place->replicate);
  }
  throw_unknown_replicate(store.directory().string(), name, names_in(store.directory() / "records"));
}

struct RerunArguments {
  std::string directory;
  std::string replicate;  ///< name of the replicate: its file in records/ without .json
  int threads = 0;
  bool json = false;  ///< print the new record
};

/// Prints whether the result has changed: on standard output, unless it contains the record.
void print_verdict(const std::string& name, const std::optional<RecordSummary>& before, const RecordSummary& now,
                   bool json, Console& console) {
  const bool same = before && before->result_digest == now.result_digest;
  const auto* verdict = !before ? "there was no valid record to compare the result with"
                        : same  ? "the result has the same bits as the record"
                                : "the result differs from the record";
  if (json) {
    console.info(verdict);
  } else {
    print(fmt::format("{}: {}\n", name, verdict));
  }
  if (before && !same) console.warn("another build computed the record, or the machine is faulty");
}

ExitCode redo(const RerunArguments& arguments, const Store& store, const ReplicateSpec& spec, Console& console) {
  const InterruptWatcher watcher;
  warn_without_fma(console);
  const auto before = store.recorded(spec);

  GraphOptions options{arguments.threads, 1, watcher.token(), [&](const ReplicateSpec& which, const Checkpoint& step) {
                         console.info(step_text(which, step.progress));
                       }};
  bool stored = false, failed = false;
  const NextReplicate once = [given = false, &spec]() mutable {
    return std::exchange(given, true) ? std::nullopt : std::optional(spec);
  };
  run_graph(once, engine_stages(), options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    store.write(outcome);
    stored = true;
    failed = outcome.failure.has_value();
  });
  if (!stored) {
    console.warn("interrupted; the record is unchanged");
    return ExitCode::interrupted;
  }
  const auto now = store.recorded(spec);
  if (!now)
    throw FileError(
        store.record_path(spec).string() + ": another process removed or changed this file; repeat the command",
        FileError::Reason::resource_failure);
  print_verdict(arguments.replicate, before, *now, arguments.json, console);
  if (arguments.json) print(read_file(store.record_path(spec)));
  return failed ? ExitCode::some_failed : ExitCode::done;
}

/// Recomputes a replicate from the start, replaces its record, and reports whether the result has the same bits as the
/// old record.
ExitCode rerun(const RerunArguments& arguments, Console& console) {
  const auto warn = [&](const std::string& message) { console.warn(message); };
  const Store store(arguments.directory, own_manifest(arguments.directory), warn);
  auto spec = planned(requests_in(arguments.directory, warn), arguments.replicate, store);
  store.keep_measures(spec);
  try {
    return redo(arguments, store, spec, console);
  } catch (const FileError& error) {
    console.error(error.what());
    return ExitCode::some_failed;
  }
}

}  // namespace

void add_rerun(CLI::App& app, Session& session) {
  RerunArguments* arguments = nullptr;
  auto options =
      add_command(app, session, "rerun",
                  "Compute one replicate again, replace its record, and report whether the result has the same bits",
                  rerun, arguments);
  options.results_directory(arguments->directory);
  options.text("replicate", arguments->replicate, "Replicate: name of its file in records/, without .json", "REPLICATE",
               Options::Need::required);
  options.flag("--json", arguments->json, "Print the new record on stdout, and the comparison on stderr");
  options.threads(arguments->threads);
}

}  // namespace isojam
