#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/records/summary.hpp"

namespace isojam {

/// Function that receives warnings about faulty files.
using Warn = std::function<void(const std::string&)>;

/// Checks whether results of this manifest may be written to a directory. It only reads files. Throws InputError if the
/// directory has the manifest of another sweep, with the keys that differ, or a record of another sweep. Damaged
/// records are reported as warnings; damaged records of the plan are recomputed later. Throws FileError if a file
/// cannot be read at the moment.
void check_directory(const std::filesystem::path& directory, const Manifest& manifest, const Warn& warn);

/// A results directory. It contains manifest.json, tables.json, and the folders records/, packings/, paths/ and
/// checkpoints/ with one file for each replicate. All files are written atomically and have a checksum. Records,
/// packings and paths do not change, except when measures are added. A checkpoint is replaced after every strain step,
/// and deleted when the record of its replicate is written. There is no index, so several shards can write to the
/// directory at the same time. If several manifests start at the same time in a fresh directory, the directory belongs
/// to one of them.
class Store {
 public:
  /// Opens the directory for a manifest, and creates missing folders. It makes all checks before it writes. Throws the
  /// same exceptions as check_directory(). Throws FileError if the directory cannot be written, or if one of its
  /// folders is a symbolic link, because results would then be written to another directory.
  Store(std::filesystem::path directory, const Manifest& manifest, Warn warn);

  /// Summary of the record of this replicate. nullopt if there is no valid record, if the packing is missing, or if the
  /// manifest keeps paths and the path is missing. A damaged record is reported as a warning. Throws InputError if the
  /// record belongs to another manifest. Throws FileError if it cannot be read at the moment; such a file does not
  /// count as damaged.
  std::optional<RecordSummary> recorded(const ReplicateSpec& spec) const;
  /// Reads the checkpoint of a replicate; nullopt if there is none. A damaged checkpoint, or a checkpoint of another
  /// build, is reported as a warning and not used. Throws FileError if it cannot be read at the moment.
  std::optional<Checkpoint> checkpoint(const ReplicateSpec& spec) const;

  void write_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) const;
  /// Writes all files of a finished replicate: first the packing and the path, then the record, so that a record always
  /// has its packing and path. Finally it deletes the checkpoint.
  void write(const Outcome& outcome) const;
  /// Replaces a record by one to which measures were added. `outcome` contains all measures. `moved` is true if states
  /// have changed because a measure first relaxed saddles to minima. Packing and path are then written again. If
  /// `moved` is false, everything except the added measures must have the same bits as in `before`; otherwise
  /// InputError is thrown.
  void write_added(const Outcome& outcome, const RecordedReplicate& before, bool moved) const;
  /// Replaces the record of a replicate that failed before any measure.
  void write_added(const ReplicateSpec& spec, const RecordedReplicate& failed) const;
  void write_tables(const Json& tables) const;

  const std::filesystem::path& directory() const { return directory_; }
  /// The manifest in manifest.json. All records belong to it. It may have more replicates than the manifest with which
  /// the store was opened.
  const Manifest& kept() const { return kept_; }
  std::filesystem::path record_path(const ReplicateSpec& spec) const { return file("records", spec); }
  std::filesystem::path packing_path(const ReplicateSpec& spec) const { return file("packings", spec); }
  std::filesystem::path path_path(const ReplicateSpec& spec) const { return file("paths", spec); }
  std::filesystem::path checkpoint_path(const ReplicateSpec& spec) const { return file("checkpoints", spec); }
  std::filesystem::path tables_path() const { return directory_ / "tables.json"; }

 private:
  std::filesystem::path file(const char* folder, const ReplicateSpec& spec) const;

  std::filesystem::path directory_;
  std::string digest_;
  bool keep_path_;
  Warn warn_;
  Manifest kept_;
};

/// Adds measures to the manifest in the directory, and returns the new manifest. The records lack these measures until
/// they are added. Throws the same exceptions as own_manifest(), and FileError if the manifest cannot be written.
Manifest extend_manifest(const std::filesystem::path& directory, const std::vector<Measure>& more);

/// Throws the error that a path is not a directory, or that the directory has no results.
[[noreturn]] void throw_without_records(const std::filesystem::path& directory);

/// Passes every record of a results directory to `use`, one at a time, in the order of their names. It warns about
/// records of another manifest, and about damaged records that are not in the plan of this manifest, and skips them.
/// Throws InputError for any other damaged record. Throws FileError if the directory has no records, or if a record
/// cannot be read at the moment.
void for_each_record(const std::filesystem::path& directory, const std::optional<Manifest>& manifest, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use);
/// The same loop for the manifest in the directory.
void for_each_record(const std::filesystem::path& directory, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use);

}  // namespace isojam
