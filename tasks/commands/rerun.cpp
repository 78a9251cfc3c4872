#include <fmt/format.h>

#include "tasks/commands.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/graph.hpp"
#include "tasks/input_error.hpp"
#include "tasks/interrupt.hpp"
#include "tasks/json_place.hpp"
#include "tasks/sealed_json.hpp"
#include "tasks/store.hpp"

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

void compare(const std::optional<RecordSummary>& before, const RecordSummary& now, Console& console) {
  if (!before) {
    console.info("there was no valid record of it");
  } else if (before->result_digest == now.result_digest) {
    console.info("the same bits as recorded before");
  } else {
    console.warn("the result differs from what was recorded before, bit for bit: another build, or a fault");
  }
}

}  // namespace

ExitCode rerun(const RerunCommand& command, Console& console) {
  const InterruptWatcher watcher;
  const auto manifest = read_manifest((std::filesystem::path(command.directory) / "manifest.json").string());
  const Store store(command.directory, manifest);
  const auto spec = planned(Plan(manifest), command.replicate, store);
  const auto warn = [&](const std::string& message) { console.warn(message); };
  const auto before = store.recorded(spec, warn);

  GraphOptions options{command.threads, 1, watcher.token(), [&](const ReplicateSpec& which, const Checkpoint& step) {
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
  compare(before, *store.recorded(spec, warn), console);
  print(read_text(store.record_path(spec).string()));
  return failed ? ExitCode::some_failed : ExitCode::done;
}

}  // namespace isojam
