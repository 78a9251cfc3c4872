#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/io/directory_lock.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/records/requests.hpp"
#include "tasks/records/summary.hpp"

namespace isojam {

/// Checks whether the replicates of this manifest may be computed in a directory. It only reads files. Throws
/// InputError if a replicate is recorded there with another specification, unless it failed: such a replicate is
/// computed again. Specifications that the manifests `accepted` request are not checked: if the correction of a failed
/// replicate has taken its name, they still run, without this replicate. Damaged records are ignored: a record of the
/// plan will be recomputed, and for others for_each_record() gives a warning. Throws FileError if a file cannot be read
/// at the moment, or if one of the folders is a symbolic link, because results would then be written to another
/// directory.
void check_directory(const std::filesystem::path& directory, const Manifest& manifest, const Requests& accepted);

/// A results directory. It contains manifest.json, tables.json, the folder manifests/ (see requests.hpp), and the
/// folders records/, packings/, paths/ and checkpoints/ with one file for each replicate. All files are written
/// atomically and have a checksum. Records, packings and paths change only if measures are added, or if a replicate is
/// repeated. A checkpoint is replaced after every strain step, and deleted when the record of its replicate is written.
/// There is no index, so several processes can write to the directory at the same time, also for different manifests. A
/// process begins with a manifest that is in conflict with another one only while no other process uses the directory.
class Store {
 public:
  /// Opens the directory for a manifest, which becomes its last one, and creates the directory and its folders if they
  /// are missing. Holds a lock on the directory. Calls check_directory() before it writes anything, and throws the same
  /// exceptions. Throws FileError if another process holds a lock that excludes this one, or if the directory cannot be
  /// written.
  Store(std::filesystem::path directory, const Manifest& manifest, Warn warn,
        DirectoryLock::Kind kind = DirectoryLock::Kind::shared);

  /// Summary of the record of this replicate; nullopt if there is no valid record. The replicate must then be computed.
  /// The record of a failed replicate with another specification is not valid. A record is also not valid in these
  /// cases, in which `warn` is called:
  /// - The file of the record is damaged.
  /// - The record does not have all measures of the manifest.
  /// - The record states a resource failure.
  /// - The packing of the replicate is damaged or missing.
  /// - The manifest keeps paths, and the path of the replicate is damaged or missing.
  ///
  /// If the name belongs to a replicate with another specification that did not fail, calls `warn` and returns a
  /// summary that has failed, with only the digest of this specification. Throws FileError if a file cannot be read at
  /// the moment; such a file does not count as damaged.
  std::optional<RecordSummary> recorded(const ReplicateSpec& spec) const;
  /// Adds the measures of a record, valid or not, to the specification from which its replicate is computed again.
  void keep_measures(ReplicateSpec& spec) const;
  /// Lock on a replicate that is being computed. Returns false if another process has it.
  bool take(const ReplicateSpec& spec) const { return locks_->take(replicate_name(spec)); }
  void release(const ReplicateSpec& spec) const { locks_->release(replicate_name(spec)); }
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
  const Manifest& manifest() const { return manifest_; }
  std::filesystem::path record_path(const ReplicateSpec& spec) const { return file("records", spec); }
  std::filesystem::path packing_path(const ReplicateSpec& spec) const { return file("packings", spec); }
  std::filesystem::path path_path(const ReplicateSpec& spec) const { return file("paths", spec); }
  std::filesystem::path checkpoint_path(const ReplicateSpec& spec) const { return file("checkpoints", spec); }
  std::filesystem::path tables_path() const { return directory_ / "tables.json"; }

 private:
  std::filesystem::path file(const char* folder, const ReplicateSpec& spec) const;

  std::filesystem::path directory_;
  Manifest manifest_;
  Warn warn_;
  std::optional<DirectoryLock> lock_;
  std::optional<NameLocks> locks_;
};

/// Throws the FileError for a path that is not a directory, or for a directory that has no records.
[[noreturn]] void throw_without_records(const std::filesystem::path& directory);

/// Passes the records of a results directory, or what is kept of them, to `use`, one at a time, in the order of their
/// names. If the directory has manifests, some records are skipped with a warning: those that have another
/// specification than requested() gives to their names, and damaged ones whose sweep point no manifest has. A failed
/// record with another specification is skipped without a warning. Also warns about records that no manifest requests
/// because their numbers are too large. Throws InputError for any other damaged record. Throws FileError if the
/// directory has no records, or if a record cannot be read at the moment.
void for_each_record(const std::filesystem::path& directory, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use,
                     const std::optional<Abridgement>& kept = std::nullopt);

}  // namespace isojam
