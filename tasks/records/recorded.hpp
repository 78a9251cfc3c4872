#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tasks/io/json.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/records/summary.hpp"

namespace isojam {

/// A replicate that was read from a results directory.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordedReplicate {
  std::string name;  ///< name of its files, without extension
  Json record;
  RecordSummary summary;
  bool is_earlier = false;  ///< true if the file of the record has the schema of an earlier version
};

/// Reads the record with this name. Throws FileError if it does not exist or cannot be read at the moment. Throws
/// InputError if it is damaged, if its result digest is wrong, or if it belongs to another replicate than its name
/// states.
RecordedReplicate read_record(const std::filesystem::path& directory, const std::string& name);

/// True if the record belongs to the sweep of this manifest. The measures may differ.
bool is_of(const RecordedReplicate& replicate, const Manifest& manifest);
/// The measures of a manifest that are missing in the record, because they were added to the manifest later.
std::vector<Measure> lacks(const RecordedReplicate& replicate, const Manifest& manifest);

/// Throws InputError unless the record has all settings of this specification. The measures may differ.
void check_spec(const RecordedReplicate& replicate, const ReplicateSpec& spec);

/// Checks the packing of a replicate that did not fail, and also its path if `with_path` is true. Throws the same
/// exceptions as read_record() if a file is missing or damaged, or belongs to another record.
void check_companions(const std::filesystem::path& directory, const RecordedReplicate& replicate, bool with_path);

/// Reads the packing or the path of the replicate; `folder` is "packings" or "paths". Throws the same exceptions as
/// read_record().
Json read_state_file_of(const std::filesystem::path& directory, const RecordedReplicate& replicate,
                        const std::string& folder);

/// True if the replicate failed because of a resource failure. An earlier version of isojam wrote records of such
/// failures.
bool is_resource_failure_record(const RecordedReplicate& replicate);

/// Throws FileError, with the same text for every command, if there is no such directory.
void expect_directory(const std::filesystem::path& directory);

/// The manifest of a results directory, or nullopt if it has none. Throws InputError if the manifest is damaged, and
/// FileError if it cannot be read at the moment.
std::optional<Manifest> stored_manifest(const std::filesystem::path& directory);
/// The manifest of a results directory. Throws if the directory has none.
Manifest own_manifest(const std::filesystem::path& directory);

/// Sorted names of the files in a folder, without extension. Empty if the folder does not exist. Temporary files of
/// write_atomically() are skipped.
std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace isojam
