#include "tasks/tables/table_of.hpp"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "tasks/manifest/manifest.hpp"
#include "tasks/replicate/summary.hpp"
#include "tasks/store/store.hpp"

namespace isojam {
namespace {

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

}  // namespace isojam
