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

namespace isojam {

/// A results directory: manifest.json, records/, packings/, paths/ and checkpoints/ with a file for each replicate,
/// tables.json. Files appear whole or not at all and vouch for their bytes; records, packings and paths never change;
/// a checkpoint is replaced after every strain step and goes when its replicate is recorded. There is no index and no
/// lock: shards write side by side.
class Store {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Opens the directory for a manifest, creating what is missing. Checks first and writes afterwards: throws
  /// InputError if the directory holds the manifest of another sweep, or a record that the plan does not know and
  /// that is damaged or of another manifest; FileError if it cannot be written, or if one of its folders is a symbolic
  /// link, through which results would end up elsewhere. What the plan knows is looked at when its turn comes.
  Store(std::filesystem::path directory, const Manifest& manifest);

  /// What a valid record of this replicate says, if it is there with its packing, and its path if it is to be kept. A
  /// damaged one is reported to `warn`. Throws InputError if the record belongs to another manifest.
  std::optional<RecordSummary> recorded(const ReplicateSpec& spec, const Warn& warn) const;
  /// Where the replicate stood. A damaged checkpoint, or one of another build, is reported and not used.
  std::optional<Checkpoint> checkpoint(const ReplicateSpec& spec, const Warn& warn) const;

  void write_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint) const;
  /// Packing and path first, so that a record vouches for them; the checkpoint goes last.
  void write(const Outcome& outcome) const;
  void write_tables(const Json& tables) const;

  const std::filesystem::path& directory() const { return directory_; }
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
};

/// Names of what a folder holds, without extension, ordered; none if there is no such folder. What writers left
/// behind is no result.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Gives every record of a results directory to `use`, one at a time, in order of names. Throws InputError for a
/// damaged record, FileError if the directory holds no records.
void for_each_record(const std::filesystem::path& directory, const std::function<void(const RecordSummary&)>& use);

}  // namespace isojam
