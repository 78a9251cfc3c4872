#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/io/json.hpp"
#include "tasks/records/store.hpp"

namespace isojam {

/// The content of a results directory, for the report.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Results {
  Json manifest;  ///< manifest in canonical form; null if there is none
  std::vector<RecordedReplicate> replicates;
};

/// Reads a results directory. Throws FileError if the directory has no records or a file cannot be read at the moment,
/// and InputError if a record is damaged.
Results read_results(const std::filesystem::path& directory, const Warn& warn);

/// Reads the state nearest jamming of a replicate. nullopt if the directory does not contain it. Throws InputError if
/// the file is damaged or belongs to another record.
std::optional<Packing> read_nearest_packing(const std::filesystem::path& directory, const RecordedReplicate& replicate);

}  // namespace isojam
