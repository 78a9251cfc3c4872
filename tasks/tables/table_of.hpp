#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/store/store.hpp"
#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// What to make a table of records with; nullopt: as their manifests say.
struct TableChoices {
  std::optional<std::vector<Flag>> exclude;
  std::optional<Json> base;
};

/// The table of all records in results directories, without the replicates that their manifests exclude, compared with
/// the base that they name, or by these choices; a directory without a manifest excludes what is usual and names no
/// base. What is left out, and that records are of different builds, is told. Throws InputError where manifests
/// disagree, and as for_each_record and Aggregation::add do.
Table table_of(const std::vector<std::string>& directories, const Warn& warn, const TableChoices& choices = {});

/// What is wrong with the base of a table: a parameter that no row has, or a value of one; nullopt if nothing is.
std::optional<std::string> misplaced_base(const Table& table);

/// The table of a run: of the records of this manifest in one directory, each of which is shown to `seen`.
Table table_of(const std::string& directory, const Manifest& manifest, const Warn& warn,
               const std::function<void(const RecordedReplicate&)>& seen);

}  // namespace isojam
