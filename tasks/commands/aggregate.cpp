#include "tasks/aggregate.hpp"

#include <filesystem>

#include "tasks/atomic_file.hpp"
#include "tasks/commands.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/store.hpp"
#include "tasks/tables.hpp"

namespace isojam {
namespace {

std::string formatted(const Table& table, TableFormat format, View view) {
  switch (format) {
    case TableFormat::json: return pretty(to_json(table));
    case TableFormat::csv: return to_csv(table, view);
    case TableFormat::latex: return to_latex(table, view);
    case TableFormat::text: break;
  }
  return to_text(table, view);
}

/// What the directories' manifests ask for, if they agree.
std::optional<Replicates> common_rule(const std::vector<std::string>& directories) {
  std::optional<Replicates> rule;
  for (const auto& directory : directories) {
    const auto path = std::filesystem::path(directory) / "manifest.json";
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return std::nullopt;
    auto next = read_manifest(path.string()).replicates;
    if (rule && *rule != next) return std::nullopt;
    rule = std::move(next);
  }
  return rule;
}

}  // namespace

Table table_of(const std::vector<std::string>& directories) {
  Aggregation aggregation;
  for (const auto& directory : directories)
    for_each_record(directory, [&](const RecordSummary& record) { aggregation.add(record); });
  return aggregation.table(common_rule(directories));
}

ExitCode aggregate_directories(const AggregateCommand& command) {
  const auto table = table_of(command.directories);
  if (!command.output.empty()) write_atomically(command.output, pretty(to_json(table)));
  print(formatted(table, command.format, command.series ? View::series : View::nearest));
  return ExitCode::done;
}

}  // namespace isojam
