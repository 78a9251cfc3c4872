#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stop_token>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/interrupt.hpp"
#include "tasks/io/memory.hpp"
#include "tasks/io/place.hpp"
#include "tasks/manifest/cohesion.hpp"
#include "tasks/manifest/cost.hpp"
#include "tasks/run/additions.hpp"
#include "tasks/run/graph.hpp"
#include "tasks/tables/table_of.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

struct MeasureArguments {
  std::string directory;
  std::vector<Measure> add;
  std::string only;  ///< name of a replicate; empty for all
  int threads = 0;
};

/// Number of records to which measures were added, and number of records that were left unchanged because of a problem.
struct AddingTally {
  std::size_t added = 0, unchanged = 0;
};

/// Adds measures to the records in `additions`, on `threads` threads. It shows the progress, and prints a warning for
/// each record that remains unchanged. `memory_bytes` is the available memory.
AddingTally add_measures(const Store& store, const Additions& additions, int threads, double memory_bytes,
                         const std::stop_token& stop, Console& console) {
  AddingTally tally;
  for (const auto& spec : additions.failed) {
    store.write_added(spec, read_record(store.directory(), replicate_name(spec)));
    ++tally.added;
  }
  const auto count = additions.measured.size();
  double work = 0, largest = 0;
  for (const auto& spec : additions.measured) {
    const auto cost = estimated_cost(spec, false);
    work += cost.cpu_seconds;
    largest = std::max(largest, cost.memory_bytes);
  }
  console.begin(static_cast<int>(count), work);
  const NextReplicate next = [&, next_index = std::size_t{0}]() mutable {
    return next_index < count ? std::optional(additions.measured[next_index++]) : std::nullopt;
  };
  const GraphOptions options{threads, replicates_in_flight(threads, largest, memory_bytes), stop, {}};
  Adder adder(store, additions.measured);
  run_graph(next, adder.stages(), options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    const auto problem = adder.finish(outcome);
    if (problem) console.warn(fmt::format("{}; the record of {} is unchanged", *problem, replicate_name(outcome.spec)));
    ++(problem ? tally.unchanged : tally.added);
    console.finished(estimated_cost(outcome.spec, false).cpu_seconds, problem.has_value());
    console.tick(replicate_name(outcome.spec));
  });
  console.end();
  return tally;
}

/// Parses names of measures, separated by commas. Returns an error text if a name is unknown.
std::optional<std::string> read_measures(const std::string& text, std::vector<Measure>& list) {
  for (std::size_t from = 0; from <= text.size();) {
    const auto end = std::min(text.find(',', from), text.size());
    const auto name = text.substr(from, end - from);
    const auto measure = from_string<Measure>(name);
    if (!measure) return unknown_name("measure", name, all_names<Measure>);
    list.push_back(*measure);
    from = end + 1;
  }
  return std::nullopt;
}

/// Throws InputError if a record cannot get the measures.
void require_possible(const std::vector<Additions::Impossible>& impossible, const std::string& directory) {
  if (impossible.empty()) return;
  const auto& [name, why] = impossible.front();
  const auto others = impossible.size() == 1 ? "" : fmt::format(" and {} more", impossible.size() - 1);
  throw InputError({directory, "", fmt::format("cannot add measures to {}{}: {}", name, others, why), "", "",
                    fmt::format("remove records/{}.json, run the manifest again, and repeat this command", name)});
}

/// Removes all replicates except `name`.
void select_replicate(Additions& additions, const std::string& name) {
  const auto is_other = [&](const ReplicateSpec& spec) { return replicate_name(spec) != name; };
  std::erase_if(additions.measured, is_other);
  std::erase_if(additions.failed, is_other);
  std::erase_if(additions.nearest_only, [&](const auto& each) { return each != name; });
  std::erase_if(additions.impossible, [&](const auto& each) { return each.name != name; });
}

void say_nearest_only(const Additions& additions, Console& console) {
  const auto count = additions.nearest_only.size();
  if (count == 0) return;
  console.info(
      fmt::format("for {} of {}, the states of the decompression were not saved (\"keep_path\": true saves them), so "
                  "isojam measures only the state nearest jamming",
                  count, counted(additions.measured.size(), "record")));
}

/// Writes the tables of all records in the directory, and prints the first one and those of the added measures.
void write_table(const Store& store, const std::vector<Measure>& added, Console& console) {
  const auto table = table_of(
      store.directory().string(), store.manifest(), [&](const std::string& message) { console.warn(message); },
      [](const RecordedReplicate&) {});
  store.write_tables(to_json(table));
  print_tables(table, store.directory().string(), added);
}

/// Adds the requested measures to the records. It also adds the measures that an interrupted call did not add.
ExitCode measure_stored(const MeasureArguments& arguments, Console& console) {
  const InterruptWatcher watcher;
  // Report a wrong directory or a wrong name first. Both functions throw in this case.
  recorded_names(arguments.directory);
  if (!arguments.only.empty()) recorded_name(arguments.directory, arguments.only);
  const auto warn = [&](const std::string& message) { console.warn(message); };
  const auto before = own_manifest(arguments.directory);
  // A manifest with such a measure would not be accepted by any later command.
  if (const auto problem = problem_of_measures(before, arguments.add))
    throw InputError({arguments.directory, "", *problem, "", "", "remove the measure from --add"});
  auto manifest = before;
  manifest.measures.insert(manifest.measures.end(), arguments.add.begin(), arguments.add.end());
  sort_measures(manifest.measures);
  // Find impossible measures before anything is written.
  auto found = additions(arguments.directory, requests_in(arguments.directory, warn), manifest.measures,
                         recorded_names(arguments.directory));
  if (manifest.measures != before.measures) require_possible(found.impossible, arguments.directory);
  const Store store(arguments.directory, manifest, warn, DirectoryLock::Kind::exclusive);
  if (!arguments.only.empty()) select_replicate(found, arguments.only);
  for (const auto& [name, why] : found.impossible)
    console.warn(fmt::format("{}: {}; \"isojam run\" recomputes this replicate", name, why));
  say_nearest_only(found, console);
  warn_without_fma(console);
  const int threads = arguments.threads > 0 ? arguments.threads : default_threads();
  if (const auto records = found.measured.size() + found.failed.size(); records > 0)
    console.info(fmt::format("{}: adding measures to {}", manifest.name, counted(records, "record")));
  const auto tally = add_measures(store, found, threads, available_memory(), watcher.token(), console);
  if (watcher.token().stop_requested()) {
    console.warn("interrupted: measures that were already added are kept; repeat the command to add the others");
    return ExitCode::interrupted;
  }
  write_table(store, arguments.add, console);
  return tally.unchanged + found.impossible.size() > 0 ? ExitCode::some_failed : ExitCode::done;
}

}  // namespace

void add_measure(CLI::App& app, Session& session) {
  MeasureArguments* arguments = nullptr;
  auto options =
      add_command(app, session, "measure", "Add measures to the records of a study", measure_stored, arguments);
  options.results_directory(arguments->directory);
  options.parsed(
      "--add", [arguments](const std::string& text) { return read_measures(text, arguments->add); }, [] {},
      "Measures to add, separated by commas (default: the measures that an interrupted isojam measure did not finish)",
      "MEASURES");
  options.text("--only", arguments->only, "Add measures only to this replicate", "REPLICATE");
  options.threads(arguments->threads);
}

}  // namespace isojam
