#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/records/summary.hpp"

namespace isojam {

/// Function that receives warnings.
using Warn = std::function<void(const std::string&)>;

/// Checks whether results of this manifest may be written to a directory. It only reads files. Throws InputError if the
/// directory has another manifest or records of another manifest; the error states what differs. The sweep of
/// `manifest` may be larger or smaller than that of the directory. Settings of failed replicates may have changed;
/// these replicates are computed again. Damaged records are ignored: a record of the plan will be recomputed, and for
/// others for_each_record() gives a warning. Throws FileError if a file cannot be read at the moment, or if one of the
/// folders is a symbolic link, because results would then be written to another directory.
void check_directory(const std::filesystem::path& directory, const Manifest& manifest);

/// A results directory. It contains manifest.json, tables.json, and the folders records/, packings/, paths/ and
/// checkpoints/ with one file for each replicate. All files are written atomically and have a checksum. Records,
/// packings and paths change only if measures are added, or if a replicate is repeated. A checkpoint is replaced after
/// every strain step, and deleted when the record of its replicate is written. There is no index, so several shards can
/// write to the directory at the same time. If several processes with different manifests start in an empty directory
/// at the same time, the directory belongs to one of them; for the others, the constructor throws InputError.
class Store {
 public:
  /// Opens the directory for a manifest, and creates the directory and its folders if they are missing. Calls
  /// check_directory() before it writes anything, and throws the same exceptions. Throws FileError if the directory
  /// cannot be written.
  Store(std::filesystem::path directory, const Manifest& manifest, Warn warn);

  /// Summary of the record of this replicate; nullopt if there is no valid record. The replicate must then be computed.
  /// A superseded record is not valid, see is_superseded(). A record is also not valid in these cases, in which `warn`
  /// is called:
  /// - The file of the record is damaged.
  /// - The record does not have all measures of the manifest.
  /// - The record states a resource failure.
  /// - The packing of the replicate is damaged or missing.
  /// - The manifest keeps paths, and the path of the replicate is damaged or missing.
  ///
  /// Throws InputError if the record belongs to another manifest. Throws FileError if a file cannot be read at the
  /// moment; such a file does not count as damaged.
  std::optional<RecordSummary> recorded(const ReplicateSpec& spec) const;
  /// Reads the checkpoint of a replicate; nullopt if there is none. If the checkpoint is damaged or belongs to another
  /// build, returns nullopt after a warning. Throws FileError if it cannot be read at the moment.
  std::optional<Checkpoint> checkpoint(const ReplicateSpec& spec) const;

  /// Replaces the checkpoint of a replicate. Writes nothing if make_checkpoint() returns nullopt.
  void write_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) const;
  /// Writes all files of a finished replicate: first the packing and the path, then the record, so that each record has
  /// its packing and path. A failed replicate has only a record. Finally deletes the checkpoint.
  void write(const Outcome& outcome) const;
  /// Replaces a record by one to which measures were added. `outcome` has all measures, and `before` is the replaced
  /// record. `moved` is true if a state has changed, because an added measure needs minima and saddles were relaxed to
  /// minima. The packing and the path are then written again. If `moved` is false, everything except the added measures
  /// must have the same bits as in `before`; otherwise throws InputError.
  void write_added(const Outcome& outcome, const RecordedReplicate& before, bool moved) const;
  /// Replaces the record of a replicate that failed before any measure, so that it states the measures of `spec`.
  void write_added(const ReplicateSpec& spec, const RecordedReplicate& failed) const;
  void write_tables(const Json& tables) const;

  const std::filesystem::path& directory() const { return directory_; }
  /// The manifest in manifest.json. It may have more replicates and a larger sweep than the manifest with which the
  /// store was opened.
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
  std::shared_ptr<const Plan> plan_;  // of kept_
};

/// Adds measures to the manifest in the directory, and returns the new manifest. It does not compute them: existing
/// records do not have these measures yet. Throws the same exceptions as own_manifest(), and FileError if the manifest
/// cannot be written.
Manifest extend_manifest(const std::filesystem::path& directory, const std::vector<Measure>& more);

/// Throws the FileError for a path that is not a directory, or for a directory that has no records.
[[noreturn]] void throw_without_records(const std::filesystem::path& directory);

/// Function that reads a record: read_record() or read_abridged_record().
using ReadRecord = RecordedReplicate (*)(const std::filesystem::path& directory, const std::string& name);

/// Passes the records of a results directory to `use`, one at a time, in the order of their names. Some records are
/// skipped with a warning: records of another manifest, and damaged records that are not in the plan of `manifest`.
/// Superseded records are skipped without a warning, see is_superseded(). If `manifest` is nullopt, no record is
/// skipped. Throws InputError for any other damaged record. Throws FileError if the directory has no records, or if a
/// record cannot be read at the moment.
void for_each_record(const std::filesystem::path& directory, const std::optional<Manifest>& manifest, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use, ReadRecord read = read_record);
/// The same loop with the manifest in the directory, if there is one.
void for_each_record(const std::filesystem::path& directory, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use, ReadRecord read = read_record);

}  // namespace isojam
