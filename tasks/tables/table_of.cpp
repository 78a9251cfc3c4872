#include "tasks/tables/table_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <utility>

#include "tasks/replicate/summary.hpp"
#include "tasks/store/recorded.hpp"
#include "tasks/store/store.hpp"

namespace isojam {
namespace {

/// What the directories' manifests ask for, if they agree.
std::optional<Replicates> common_rule(const std::vector<std::string>& directories) {
  std::optional<Replicates> rule;
  for (const auto& directory : directories) {
    auto manifest = stored_manifest(directory);
    if (!manifest || (rule && *rule != manifest->replicates)) return std::nullopt;
    rule = std::move(manifest->replicates);
  }
  return rule;
}

}  // namespace

Table table_of(const std::vector<std::string>& directories, const Warn& warn) {
  Aggregation aggregation;
  for (const auto& directory : directories)
    for_each_record(directory, warn, [&](const RecordSummary& record) { aggregation.add(record); });
  auto table = aggregation.table(common_rule(directories));
  if (table.builds.size() > 1)
    warn(fmt::format("the records are of {} builds of isojam, which may round differently: {}", table.builds.size(),
                     fmt::join(table.builds, "; ")));
  return table;
}

}  // namespace isojam
