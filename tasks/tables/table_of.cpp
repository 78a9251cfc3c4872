#include "tasks/tables/table_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <optional>
#include <set>

#include "tasks/io/input_error.hpp"
#include "tasks/io/options.hpp"
#include "tasks/manifest/base.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/store.hpp"
#include "tasks/records/summary.hpp"

namespace isojam {
namespace {

std::string manifest_path(const std::string& directory) {
  return (std::filesystem::path(directory) / "manifest.json").string();
}

/// Manifest of each directory, or nullopt for a directory without a manifest.
std::vector<std::optional<Manifest>> manifests_of(const std::vector<std::string>& directories) {
  std::vector<std::optional<Manifest>> manifests;
  for (const auto& directory : directories) {
    manifests.push_back(stored_manifest(directory));
  }
  return manifests;
}

/// The number of replicates and the stopping rule of the manifests, if all manifests agree.
std::optional<Replicates> common_rule(const std::vector<std::optional<Manifest>>& manifests) {
  for (const auto& manifest : manifests) {
    if (!manifest || !manifests.front() || manifest->replicates != manifests.front()->replicates) return std::nullopt;
  }
  return manifests.empty() ? std::nullopt : std::optional(manifests.front()->replicates);
}

/// The choice on which all manifests agree, or `usual` if there are no manifests. Throws if they disagree. json(choice)
/// is used in the message.
template <class Choice, class ToJson>
Choice common_choice(const std::vector<std::string>& directories, const std::vector<std::optional<Manifest>>& manifests,
                     Choice Manifest::*choice, const std::string& key, const Choice& usual, const ToJson& json) {
  const auto of = [&](std::size_t k) -> const Choice& { return manifests[k] ? (*manifests[k]).*choice : usual; };
  for (std::size_t k = 1; k < manifests.size(); ++k) {
    if (of(k) == of(0)) continue;
    throw InputError({manifest_path(directories[k]), "/" + key,
                      fmt::format("{} here, but {} in {}", json(of(k)), json(of(0)), directories[0]), "", "",
                      fmt::format("choose one value with --{}, or aggregate the directories separately", key)});
  }
  return manifests.empty() ? usual : of(0);
}

std::vector<Flag> common_exclusions(const std::vector<std::string>& directories,
                                    const std::vector<std::optional<Manifest>>& manifests) {
  return common_choice(directories, manifests, &Manifest::exclude, "exclude", usually_excluded(),
                       [](const std::vector<Flag>& flags) { return compact(option_json(flags)); });
}

Json common_base(const std::vector<std::string>& directories, const std::vector<std::optional<Manifest>>& manifests) {
  return common_choice(directories, manifests, &Manifest::base, "base", Json(Json::object()),
                       [](const Json& base) { return base.empty() ? "not given" : compact(base); });
}

/// The parameters of the rows, each with all values that occur.
SweptValues swept_in(const Table& table) {
  std::map<std::string, std::set<Json>> values;
  for (const auto& row : table.rows) {
    for (const auto& item : row.parameters.items()) values[item.key()].insert(item.value());
  }
  SweptValues swept;
  for (const auto& [name, list] : values) swept[name].assign(list.begin(), list.end());
  return swept;
}

Table told(Table table, const Warn& warn) {
  if (table.builds.size() > 1)
    warn(fmt::format("the records come from {} builds of isojam, which may round differently: {}", table.builds.size(),
                     fmt::join(table.builds, "; ")));
  return table;
}

}  // namespace

Table table_of(const std::vector<std::string>& directories, const Warn& warn, const TableChoices& choices) {
  const auto manifests = manifests_of(directories);
  Aggregation aggregation(choices.exclude ? *choices.exclude : common_exclusions(directories, manifests),
                          choices.base ? *choices.base : common_base(directories, manifests));
  for (const auto& directory : directories)
    for_each_record(
        directory, warn, [&](const RecordedReplicate& held) { aggregation.add(held.summary); },
        Abridgement{choices.series ? States::all : States::nearest});
  return told(aggregation.table(common_rule(manifests)), warn);
}

std::optional<std::string> misplaced_base(const Table& table) {
  try {
    check_base({table.base, "--base"}, table.base, swept_in(table));
  } catch (const InputError& error) {
    return one_line(error.details());
  }
  return std::nullopt;
}

Table table_of(const std::string& directory, const Manifest& manifest, const Warn& warn,
               const std::function<void(const RecordedReplicate&)>& seen) {
  Aggregation aggregation(manifest.exclude, manifest.base);
  for_each_record(
      directory, warn,
      [&](const RecordedReplicate& held) {
        aggregation.add(held.summary);
        seen(held);
      },
      Abridgement{});
  return told(aggregation.table(manifest.replicates), warn);
}

}  // namespace isojam
