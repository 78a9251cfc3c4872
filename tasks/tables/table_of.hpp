#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/store/store.hpp"
#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// The table of all records in results directories, without the replicates that their manifests exclude, or `exclude`
/// if it is given; a directory without a manifest excludes what is usual. What is left out, and that records are of
/// different builds, is told. Throws InputError where manifests disagree, and as for_each_record and Aggregation::add
/// do.
Table table_of(const std::vector<std::string>& directories, const Warn& warn,
               const std::optional<std::vector<Flag>>& exclude = std::nullopt);

/// The table of a run: of the records of this manifest in one directory, each of which is shown to `seen`.
Table table_of(const std::string& directory, const Manifest& manifest, const Warn& warn,
               const std::function<void(const RecordedReplicate&)>& seen);

}  // namespace isojam
