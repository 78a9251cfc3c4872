#include <fmt/format.h>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/json/place.hpp"
#include "tasks/json/sealed.hpp"
#include "tasks/replicate/summary.hpp"
#include "tasks/run/graph.hpp"
#include "tasks/store/store.hpp"
#include "tasks/system/file.hpp"
#include "tasks/system/interrupt.hpp"
#include "tasks/system/standard_streams.hpp"

namespace isojam {
namespace {

ReplicateSpec planned(const Plan& plan, const std::string& name, const Store& store) {
  if (const auto place = plan.place_of(name)) return plan.at(place->point, place->replicate);
  const auto known = names_in(store.directory() / "records");
  const std::vector<std::string_view> names(known.begin(), known.end());
  const auto nearest = nearest_name(name, names);
  throw FileError(fmt::format("{}: plans no replicate \"{}\"{}", (store.directory() / "manifest.json").string(), name,
                              nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
}

struct Arguments {
  std::string directory;
  std::string replicate;  ///< name, as its files are called
  int threads = 0;
};

void compare(const std::optional<RecordSummary>& before, const RecordSummary& now, Console& console) {
  if (!before) {
    console.info("there was no valid record of it");
  } else if (before->result_digest == now.result_digest) {
    console.info("the same bits as recorded before");
  } else {
    console.warn("the result differs from what was recorded before, bit for bit: another build, or a fault");
  }
}

ExitCode redo(const Arguments& arguments, const Store& store, const ReplicateSpec& spec, Console& console) {
  const InterruptWatcher watcher;
  warn_about_kernels(console);
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
    console.warn("interrupted; the record is as it was");
    return ExitCode::interrupted;
  }
  const auto now = store.recorded(spec);
  if (!now)
    throw FileError(store.record_path(spec).string() + ": has gone or changed since it was written",
                    FileError::Reason::shortage);
  compare(before, *now, console);
  print(read_file(store.record_path(spec)));
  return failed ? ExitCode::some_failed : ExitCode::done;
}

/// Recomputes a replicate from the start, replaces its record and reports whether the bits are identical. The record
/// goes to stdout.
ExitCode rerun(const Arguments& arguments, Console& console) {
  auto manifest = own_manifest(arguments.directory);
  load_start(manifest);
  const Store store(arguments.directory, manifest, [&](const std::string& message) { console.warn(message); });
  const auto spec = planned(Plan(manifest), arguments.replicate, store);
  try {
    return redo(arguments, store, spec, console);
  } catch (const FileError& error) {
    console.error(error.what());
    return ExitCode::some_failed;
  }
}

}  // namespace

void add_rerun(CLI::App& app, Session& session) {
  Arguments* arguments = nullptr;
  auto options =
      add_command(app, session, "rerun", "Redo one replicate, with a line for every strain step", rerun, arguments);
  options.results_directory(arguments->directory);
  options.text("replicate", arguments->replicate, "Its name, as its files are called", "REPLICATE",
               Options::Need::required);
  options.threads(arguments->threads);
}

}  // namespace isojam
