#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/replicate/replicate.hpp"
#include "tasks/replicate/summary.hpp"
#include "tasks/store/recorded.hpp"

namespace isojam {

/// Told of what is wrong with a file, and what becomes of it.
using Warn = std::function<void(const std::string&)>;

/// Throws InputError unless a directory may take the results of this manifest: if it holds the manifest of another
/// sweep, with the keys that differ, or the record of one. Records that are damaged are reported and no obstacle: those
/// of the plan are redone when their turn comes. FileError if something cannot be read now. Reads only.
void check_directory(const std::filesystem::path& directory, const Manifest& manifest, const Warn& warn);

/// A results directory: manifest.json, records/, packings/, paths/ and checkpoints/ with a file for each replicate,
/// tables.json. Files appear whole or not at all and vouch for their bytes; records, packings and paths never change;
/// a checkpoint is replaced after every strain step and goes when its replicate is recorded. There is no index and no
/// lock: shards write side by side, and of several manifests that begin at once in a fresh directory one gets it.
class Store {
 public:
  /// Opens the directory for a manifest, creating what is missing. Checks first and writes afterwards: throws as
  /// check_directory does; FileError if it cannot be written, or if one of its folders is a symbolic link, through
  /// which results would end up elsewhere.
  Store(std::filesystem::path directory, const Manifest& manifest, Warn warn);

  /// Summary of a valid record of this replicate, if it has its packing, and its path if paths are kept. A damaged one
  /// is reported. Throws InputError if the record belongs to another manifest; FileError if it cannot be read now,
  /// which is not to be damaged.
  std::optional<RecordSummary> recorded(const ReplicateSpec& spec) const;
  /// Where the replicate stood. A damaged checkpoint, or one of another build, is reported and not used. Throws
  /// FileError if it cannot be read now.
  std::optional<Checkpoint> checkpoint(const ReplicateSpec& spec) const;

  void write_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) const;
  /// Packing and path first, so that a record vouches for them; the checkpoint goes last.
  void write(const Outcome& outcome) const;
  /// Replaces a record by the same with measures added, `outcome` with all of them: what it says otherwise must come
  /// out as it was. `moved`: states have changed on the way, as those do that are followed to minima first, and are
  /// written again. Throws InputError if the record cannot be made again bit for bit.
  void write_added(const Outcome& outcome, const RecordedReplicate& before, bool moved) const;
  /// The same for a replicate that failed before anything was measured.
  void write_added(const ReplicateSpec& spec, const RecordedReplicate& failed) const;
  void write_tables(const Json& tables) const;

  const std::filesystem::path& directory() const { return directory_; }
  /// The manifest of manifest.json: the plan that the records belong to, which may be larger than the one
  /// that the store was opened for.
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

/// Makes these measures a part of the manifest that the directory keeps, which is returned: its records lack them until
/// they are added. Throws as own_manifest does, FileError if it cannot be written.
Manifest extend_manifest(const std::filesystem::path& directory, const std::vector<Measure>& more);

/// Says that a directory is none, or holds no results.
[[noreturn]] void throw_without_records(const std::filesystem::path& directory);

/// Gives every record of a results directory to `use`, one at a time, in order of names. Reported and left out are
/// those of another manifest than this one, and damaged ones that its plan does not know. Throws InputError for
/// any other that is damaged, FileError if the directory holds no records or one cannot be read now.
void for_each_record(const std::filesystem::path& directory, const std::optional<Manifest>& manifest, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use);
/// The same for the manifest that the directory keeps.
void for_each_record(const std::filesystem::path& directory, const Warn& warn,
                     const std::function<void(RecordedReplicate)>& use);

}  // namespace isojam
