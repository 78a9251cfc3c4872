#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/io/json.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/records/abridged.hpp"
#include "tasks/records/summary.hpp"

namespace isojam {

/// A replicate that was read from a results directory.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordedReplicate {
  std::string name;  ///< name of its files, without extension
  Json record;       ///< the file as JSON
  Record document;   ///< the same file
  RecordSummary summary;
  /// index of the nearest state in the file; only if `record` has no other state
  std::optional<std::size_t> nearest = std::nullopt;

  /// Pairs with a smaller gap count as contacts; 0 unless the packing was measured as given.
  double gap() const { return document.spec.value(Json::json_pointer("/start/gap"), 0.0); }
};

/// Reads the record with this name. Throws FileError if it cannot be read at the moment. Throws InputError if it is
/// missing or damaged, if its result digest is wrong, or if it describes another replicate than its name. Takes less
/// time if only a part of the record is kept; the result digest is then not checked.
RecordedReplicate read_record(const std::filesystem::path& directory, const std::string& name,
                              const std::optional<Abridgement>& kept = std::nullopt);

/// Calls `read` with each name, several at the same time, and what it returns one after the other in the order of the
/// names. The first exception in this order ends it.
void read_in_order(const std::vector<std::string>& names,
                   const std::function<std::function<void()>(const std::string&)>& read);

/// Those of the measures that the record does not have.
std::vector<Measure> lacks(const RecordedReplicate& replicate, const std::vector<Measure>& measures);

/// Checks the packing file of a replicate, and also its path file if `with_path` is true. Does nothing if the replicate
/// failed. Throws FileError if a file cannot be read at the moment. Throws InputError if a file is missing or damaged,
/// or belongs to another record.
void check_companions(const std::filesystem::path& directory, const RecordedReplicate& replicate, bool with_path);

/// Reads the packing file or the path file of a replicate; `folder` is "packings" or "paths". Throws the same
/// exceptions as check_companions().
Json read_state_file_of(const std::filesystem::path& directory, const RecordedReplicate& replicate,
                        const std::string& folder);

/// Reads the nearest state of a replicate from its packing file; nullopt if there is no such file. Throws InputError if
/// the file is damaged or belongs to another record. Throws FileError if it cannot be read at the moment.
std::optional<Packing> read_nearest_packing(const std::filesystem::path& directory, const RecordedReplicate& replicate);

/// Throws FileError if the directory does not exist or is not a directory. The text of the error is the same for every
/// command.
void expect_directory(const std::filesystem::path& directory);

/// The manifest in a results directory; nullopt if there is none. Throws FileError if the manifest cannot be read at
/// the moment. Throws InputError if the manifest is damaged or not valid.
std::optional<Manifest> stored_manifest(const std::filesystem::path& directory);
/// The manifest in a results directory. Throws the same exceptions as stored_manifest() and expect_directory(). If the
/// directory has records but no manifest, throws InputError. If it has neither, throws FileError.
Manifest own_manifest(const std::filesystem::path& directory);

/// Names of the JSON files in a folder, sorted and without extension. Empty if the folder does not exist. Hidden files,
/// such as the temporary files of write_atomically(), are left out. Throws FileError if the folder cannot be listed.
std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace isojam
