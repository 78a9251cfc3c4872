#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/store/store.hpp"
#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// Choices for a table of records; nullopt: as in their manifests.
struct TableChoices {
  std::optional<std::vector<Flag>> exclude;
  std::optional<Json> base;
};

/// The table of all records in results directories. Excluded flags and the base come from the manifests or from these
/// choices. A directory without a manifest excludes the default flags and has no base. Warns about excluded replicates
/// and about records of different builds. Throws InputError if manifests disagree, and as for_each_record and
/// Aggregation::add do.
Table table_of(const std::vector<std::string>& directories, const Warn& warn, const TableChoices& choices = {});

/// Error text if the base of a table has a parameter, or a value of one, that no row has; nullopt otherwise.
std::optional<std::string> misplaced_base(const Table& table);

/// The table of a run: records of this manifest in one directory. `seen` is called with each record.
Table table_of(const std::string& directory, const Manifest& manifest, const Warn& warn,
               const std::function<void(const RecordedReplicate&)>& seen);

}  // namespace isojam
