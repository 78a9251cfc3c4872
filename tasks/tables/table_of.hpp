#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/records/store.hpp"
#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// Choices for a table. nullopt means: as in the manifests of the directories.
struct TableChoices {
  std::optional<std::vector<Flag>> exclude;  ///< flags to exclude
  std::optional<Json> base;
  /// If false, Row::series remains empty. The table then takes about a third of the time.
  bool series = true;
};

/// Makes the table of all records in one or several results directories. The excluded flags and the base are those in
/// `choices`. Where `choices` has none, they are those of the manifests; a directory without a manifest has
/// usually_excluded() and no base. Warns like for_each_record(), and also if the records were made by different builds.
/// Throws InputError if the manifests differ in the excluded flags or in the base. Also throws the exceptions of
/// for_each_record() and Aggregation::add().
Table table_of(const std::vector<std::string>& directories, const Warn& warn, const TableChoices& choices = {});

/// Error message if the base of a table has a parameter or a value that no row has; nullopt otherwise.
std::optional<std::string> misplaced_base(const Table& table);

/// Makes the table of a run, from the records of this manifest in one directory. `seen` is called with each record.
Table table_of(const std::string& directory, const Manifest& manifest, const Warn& warn,
               const std::function<void(const RecordedReplicate&)>& seen);

}  // namespace isojam
