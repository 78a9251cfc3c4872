#include "tasks/tables/table_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "tasks/json/input_error.hpp"
#include "tasks/json/options.hpp"
#include "tasks/replicate/summary.hpp"
#include "tasks/store/recorded.hpp"
#include "tasks/store/store.hpp"

namespace isojam {
namespace {

std::string manifest_path(const std::string& directory) {
  return (std::filesystem::path(directory) / "manifest.json").string();
}

/// Of each directory; nullopt where there is none.
std::vector<std::optional<Manifest>> manifests_of(const std::vector<std::string>& directories) {
  std::vector<std::optional<Manifest>> manifests;
  for (const auto& directory : directories) {
    manifests.push_back(stored_manifest(directory));
  }
  return manifests;
}

/// What the manifests ask for, if they agree.
std::optional<Replicates> common_rule(const std::vector<std::optional<Manifest>>& manifests) {
  for (const auto& manifest : manifests) {
    if (!manifest || !manifests.front() || manifest->replicates != manifests.front()->replicates) return std::nullopt;
  }
  return manifests.empty() ? std::nullopt : std::optional(manifests.front()->replicates);
}

std::vector<Flag> common_exclusions(const std::vector<std::string>& directories,
                                    const std::vector<std::optional<Manifest>>& manifests) {
  const auto of = [&](std::size_t k) { return manifests[k] ? manifests[k]->exclude : usually_excluded(); };
  for (std::size_t k = 1; k < manifests.size(); ++k) {
    if (of(k) == of(0)) continue;
    throw InputError(
        {manifest_path(directories[k]), "/exclude",
         fmt::format("is {}, and {} of {}", option_json(of(k)).dump(), option_json(of(0)).dump(), directories[0]),
         "directories that exclude the same, or a choice by --exclude", ""});
  }
  return manifests.empty() ? usually_excluded() : of(0);
}

Table told(Table table, const Warn& warn) {
  if (table.builds.size() > 1)
    warn(fmt::format("the records are of {} builds of isojam, which may round differently: {}", table.builds.size(),
                     fmt::join(table.builds, "; ")));
  return table;
}

}  // namespace

Table table_of(const std::vector<std::string>& directories, const Warn& warn,
               const std::optional<std::vector<Flag>>& exclude) {
  const auto manifests = manifests_of(directories);
  Aggregation aggregation(exclude ? *exclude : common_exclusions(directories, manifests));
  for (const auto& directory : directories)
    for_each_record(directory, warn, [&](const RecordedReplicate& held) { aggregation.add(held.summary); });
  return told(aggregation.table(common_rule(manifests)), warn);
}

Table table_of(const std::string& directory, const Manifest& manifest, const Warn& warn,
               const std::function<void(const RecordedReplicate&)>& seen) {
  Aggregation aggregation(manifest.exclude);
  for_each_record(directory, manifest, warn, [&](const RecordedReplicate& held) {
    aggregation.add(held.summary);
    seen(held);
  });
  return told(aggregation.table(manifest.replicates), warn);
}

}  // namespace isojam
