#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tasks/json/json.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/replicate/summary.hpp"

namespace isojam {

/// A replicate as its directory holds it.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordedReplicate {
  std::string name;  ///< of its files, without extension
  Json record;
  RecordSummary summary;
};

/// The record of that name. Throws FileError if it is not there or cannot be read now; InputError if it is damaged,
/// does not have the result digest that it states, or is of another replicate than its name says.
RecordedReplicate read_record(const std::filesystem::path& directory, const std::string& name);

/// True if the record belongs to the sweep of this manifest, whatever was measured.
bool is_of(const RecordedReplicate& replicate, const Manifest& manifest);
/// The measures of a manifest that the record lacks, because they were added to the manifest later.
std::vector<Measure> lacks(const RecordedReplicate& replicate, const Manifest& manifest);

/// Throws InputError unless the record has all the settings of this specification, measures apart.
void check_spec(const RecordedReplicate& replicate, const ReplicateSpec& spec);

/// Throws, as read_record does, unless the packing of a replicate that did not fail is there and its own, and its path
/// if `with_path`.
void check_companions(const std::filesystem::path& directory, const RecordedReplicate& replicate, bool with_path);

/// A packing or a path of that replicate; `folder` is "packings" or "paths". Throws as read_record does.
Json read_companion_of(const std::filesystem::path& directory, const RecordedReplicate& replicate,
                       const std::string& folder);

/// True if what failed was the machine and not the replicate. An earlier version recorded that as an outcome.
bool failed_for_want(const RecordedReplicate& replicate);

/// The manifest that a results directory belongs to; nullopt if it has none. Throws InputError for one that is damaged,
/// FileError for one that cannot be read now.
std::optional<Manifest> stored_manifest(const std::filesystem::path& directory);
/// The same, where there must be one.
Manifest own_manifest(const std::filesystem::path& directory);

/// Names of the files in a folder, without extension, ordered; none if there is no such folder. Temporary files of
/// writers are skipped.
std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace isojam
