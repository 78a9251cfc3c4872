#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/json/place.hpp"
#include "tasks/run/adding.hpp"
#include "tasks/run/graph.hpp"
#include "tasks/system/file.hpp"
#include "tasks/system/interrupt.hpp"
#include "tasks/system/standard_streams.hpp"
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

/// Names of measures with commas between.
std::optional<std::string> read_measures(const std::string& text, std::vector<Measure>& list) {
  for (std::size_t from = 0; from <= text.size();) {
    const auto end = std::min(text.find(',', from), text.size());
    const auto name = text.substr(from, end - from);
    const auto measure = from_string<Measure>(name);
    if (!measure) {
      const auto near = nearest_name(name, all_names<Measure>);
      return fmt::format("no measure \"{}\"{}; there are {}", name,
                         near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near),
                         quoted_list(all_names<Measure>));
    }
    list.push_back(*measure);
    from = end + 1;
  }
  return std::nullopt;
}

/// Of the records that are there.
std::vector<std::string> chosen(const MeasureArguments& arguments) {
  auto names = names_in(std::filesystem::path(arguments.directory) / "records");
  if (names.empty()) throw_without_records(arguments.directory);
  if (arguments.only.empty()) return names;
  if (std::find(names.begin(), names.end(), arguments.only) != names.end()) return {arguments.only};
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const auto near = nearest_name(arguments.only, candidates);
  throw FileError(fmt::format("{}: holds no replicate \"{}\"{}", arguments.directory, arguments.only,
                              near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

struct Tally {
  std::size_t added = 0, left = 0;
};

void add_one(const Store& store, const Outcome& outcome, Tally& tally, Console& console) {
  const auto name = replicate_name(outcome.spec);
  if (outcome.failure) {
    console.warn(fmt::format("{} failed in {}: {}; its record is as it was", name, outcome.failure->where,
                             outcome.failure->why));
    ++tally.left;
    return;
  }
  const auto before = read_record(store.directory(), name);
  store.write_added(outcome, before, has_moved(outcome.jam, before));
  ++tally.added;
}

Tally add_all(const Store& store, const Additions& additions, const GraphOptions& options, Console& console) {
  Tally tally{0, additions.not_measured.size()};
  for (const auto& name : additions.not_measured)
    console.warn(fmt::format("{} failed in a measure, and its states were not kept; isojam rerun makes it anew", name));
  for (const auto& spec : additions.failed) {
    store.write_added(spec, read_record(store.directory(), replicate_name(spec)));
    ++tally.added;
  }
  const auto count = additions.measured.size();
  console.begin(static_cast<int>(count), static_cast<double>(count));
  const NextReplicate next = [&, at = std::size_t{0}]() mutable {
    return at < count ? std::optional(additions.measured[at++].spec) : std::nullopt;
  };
  run_graph(next, adding_stages(store.directory()), options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    add_one(store, outcome, tally, console);
    console.finished(1, outcome.failure.has_value());
    console.tick(replicate_name(outcome.spec));
  });
  console.end();
  return tally;
}

/// The table again, if no record lacks anything any more.
void write_table(const Store& store, Console& console) {
  const auto table = table_of(
      store.directory().string(), store.kept(), [&](const std::string& message) { console.warn(message); },
      [](const RecordedReplicate&) {});
  store.write_tables(to_json(table));
  print(to_text(table));
}

/// Measures stored packings: what is asked for, and what an interrupted call has left.
ExitCode measure_stored(const MeasureArguments& arguments, Console& console) {
  const InterruptWatcher watcher;
  const auto names = chosen(arguments);
  auto manifest = with_measures(own_manifest(arguments.directory), arguments.add);
  load_start(manifest);
  const Plan plan(manifest);
  // Refused before anything is written.
  const auto found = additions(arguments.directory, plan, names);
  extend_manifest(arguments.directory, arguments.add);
  const Store store(arguments.directory, manifest, [&](const std::string& message) { console.warn(message); });
  const int threads = arguments.threads > 0 ? arguments.threads : default_threads();
  console.info(fmt::format("{}: measures to add to {}", manifest.name, counted(found.measured.size(), "record")));
  const auto tally = add_all(store, found, {threads, threads, watcher.token(), {}}, console);
  if (watcher.token().stop_requested()) {
    console.warn("interrupted; what was added is kept, and isojam measure continues");
    return ExitCode::interrupted;
  }
  write_table(store, console);
  return tally.left > 0 ? ExitCode::some_failed : ExitCode::done;
}

}  // namespace

void add_measure(CLI::App& app, Session& session) {
  MeasureArguments* arguments = nullptr;
  auto options = add_command(app, session, "measure", "Measure stored packings: add to records what was not asked for",
                             measure_stored, arguments);
  options.results_directory(arguments->directory);
  options.parsed(
      "--add", [arguments](const std::string& text) { return read_measures(text, arguments->add); }, [] {},
      "Measures to add, as a manifest calls them, with commas between (default: those that an interrupted call left)",
      "MEASURES");
  options.text("--only", arguments->only, "Of this replicate alone", "REPLICATE");
  options.threads(arguments->threads);
}

}  // namespace isojam
