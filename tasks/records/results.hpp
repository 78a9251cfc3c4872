#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/io/json.hpp"
#include "tasks/records/store.hpp"

namespace isojam {

/// The content of a results directory that the report shows.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Results {
  Json manifest;  ///< manifest in canonical form; null if the directory has none
  std::vector<RecordedReplicate> replicates;
};

/// Reads a results directory. It warns about the same records as for_each_record() and skips them. Throws FileError if
/// the directory has no records, or if a file cannot be read at the moment. Throws InputError if the manifest is
/// damaged, or a record that is not skipped.
Results read_results(const std::filesystem::path& directory, const Warn& warn);

/// Reads the nearest state of a replicate from its packing file; nullopt if there is no such file. Throws InputError if
/// the file is damaged or belongs to another record. Throws FileError if it cannot be read at the moment.
std::optional<Packing> read_nearest_packing(const std::filesystem::path& directory, const RecordedReplicate& replicate);

}  // namespace isojam
