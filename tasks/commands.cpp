#include "tasks/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "tasks/aggregate.hpp"
#include "tasks/atomic_file.hpp"
#include "tasks/graph.hpp"
#include "tasks/interrupt.hpp"
#include "tasks/store.hpp"
#include "tasks/tables.hpp"

namespace isojam {
namespace {

/// Cost of a replicate relative to others, for the time left: overlaps per evaluation grow with N.
double work_of(const ReplicateSpec& spec) { return spec.particles; }

std::vector<ReplicateSpec> missing_of(const std::vector<ReplicateSpec>& plan, const Store& store, Console& console) {
  std::vector<ReplicateSpec> missing;
  const auto warn = [&](const std::string& message) { console.warn(message); };
  std::copy_if(plan.begin(), plan.end(), std::back_inserter(missing),
               [&](const ReplicateSpec& spec) { return !store.holds(spec, warn); });
  return missing;
}

std::string step_text(const ReplicateSpec& spec, const JamStep& step) {
  return fmt::format("{}: {} at density {:.4f}, E/N {:.1e}, residual {:.1e}", replicate_name(spec),
                     to_string(step.stage), step.density, step.energy_per_particle, step.summary.residual);
}

/// Runs and stores; returns how many outcomes were stored.
std::size_t run_missing(const std::vector<ReplicateSpec>& missing, const Store& store, GraphOptions options,
                        Console& console) {
  double work = 0;
  for (const auto& spec : missing) work += work_of(spec);
  console.begin(static_cast<int>(missing.size()), work);
  std::size_t stored = 0;
  options.on_step = [&](const ReplicateSpec& spec, const JamStep& step) { console.tick(step_text(spec, step)); };
  run_graph(missing, engine_stages(), options, [&](const Outcome& outcome) {
    if (outcome.interrupted) return;
    store.write(outcome);
    ++stored;
    console.finished(work_of(outcome.spec), outcome.failure.has_value());
    const auto name = replicate_name(outcome.spec);
    if (outcome.failure) {
      console.warn(fmt::format("{} failed in {}: {}", name, outcome.failure->where, outcome.failure->why));
    } else {
      console.detail(fmt::format("{}: phi_j {:.6f}, {} evaluations, {}", name, outcome.jam.phi_j->density,
                                 outcome.jam.evaluations, duration_text(outcome.timing.wall_seconds)));
    }
    console.tick(name);
  });
  console.end();
  return stored;
}

void print(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

std::string formatted(const Table& table, TableFormat format, View view) {
  switch (format) {
    case TableFormat::json: return pretty(to_json(table));
    case TableFormat::csv: return to_csv(table, view);
    case TableFormat::latex: return to_latex(table, view);
    case TableFormat::text: break;
  }
  return to_text(table, view);
}

}  // namespace

ExitCode run(const RunCommand& command, Console& console) {
  const InterruptWatcher watcher;
  const auto manifest = read_manifest(command.manifest);
  const auto plan = make_plan(manifest);
  const auto directory = command.directory.empty() ? "results/" + manifest.name : command.directory;
  const Store store(directory, manifest);
  const auto missing = missing_of(plan, store, console);
  console.info(fmt::format("{}: {} replicates, {} recorded already, results in {}", manifest.name, plan.size(),
                           plan.size() - missing.size(), directory));

  const auto stored = run_missing(missing, store, {command.threads, watcher.token(), {}}, console);
  if (stored < missing.size()) {
    console.warn(fmt::format("interrupted; {} of {} replicates are recorded, and the same command continues",
                             plan.size() - missing.size() + stored, plan.size()));
    return ExitCode::interrupted;
  }
  const auto table = aggregate(read_records(directory));
  store.write_tables(to_json(table));
  print(to_text(table));
  const bool failed = std::any_of(table.rows.begin(), table.rows.end(), [](const Row& row) { return row.failed > 0; });
  return failed ? ExitCode::some_failed : ExitCode::done;
}

ExitCode validate(const ValidateCommand& command) {
  const auto manifest = read_manifest(command.manifest);
  const auto replicates = make_plan(manifest).size();
  print(fmt::format("OK: {}: {} replicates ({} sweep points × {})\n", manifest.name, replicates,
                    replicates / static_cast<std::size_t>(manifest.replicates), manifest.replicates));
  return ExitCode::done;
}

ExitCode aggregate_directories(const AggregateCommand& command) {
  std::vector<RecordSummary> records;
  for (const auto& directory : command.directories) {
    auto more = read_records(directory);
    std::move(more.begin(), more.end(), std::back_inserter(records));
  }
  const auto table = aggregate(records);
  if (!command.output.empty()) write_atomically(command.output, pretty(to_json(table)));
  print(formatted(table, command.format, command.series ? View::series : View::nearest));
  return ExitCode::done;
}

}  // namespace isojam
