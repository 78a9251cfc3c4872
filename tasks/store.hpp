#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest.hpp"
#include "tasks/plan.hpp"
#include "tasks/record.hpp"

namespace isojam {

/// A results directory: manifest.json, records/, packings/, tables.json. Files are immutable once written, and
/// appear whole or not at all; there is no index and no lock.
class Store {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Opens the directory for a manifest, creating what is missing. Checks first and writes afterwards: throws
  /// InputError if the directory holds the manifest or a record of another one, or a damaged record that the plan
  /// would not replace; FileError if it cannot be written.
  Store(std::filesystem::path directory, const Manifest& manifest);

  /// True if a valid record of this replicate, and its packing, are there. A damaged one is reported to `warn`.
  bool holds(const ReplicateSpec& spec, const Warn& warn) const;
  /// The packing first, so that a record vouches for it.
  void write(const Outcome& outcome) const;
  void write_tables(const Json& tables) const;

  std::filesystem::path record_path(const ReplicateSpec& spec) const;
  std::filesystem::path packing_path(const ReplicateSpec& spec) const;
  std::filesystem::path tables_path() const { return directory_ / "tables.json"; }

 private:
  std::filesystem::path directory_;
};

/// Names of the replicates that a results directory holds records of, ascending. Throws FileError if there are none.
std::vector<std::string> recorded_names(const std::filesystem::path& directory);

/// Every record of a results directory, in order of file name. Throws InputError for a damaged record, FileError if
/// the directory holds no records.
std::vector<RecordSummary> read_records(const std::filesystem::path& directory);

}  // namespace isojam
