#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/json/json.hpp"
#include "tasks/store/store.hpp"

namespace isojam {

/// The contents of a results directory, for a report.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Results {
  Json manifest;  ///< canonical; null if there is none
  std::vector<RecordedReplicate> replicates;
};

/// Throws FileError if the directory holds no records or something cannot be read now, InputError for a damaged record.
Results read_results(const std::filesystem::path& directory, const Warn& warn);

/// The state nearest jamming; nullopt if the directory does not hold it. Throws InputError if it is damaged or
/// another record's.
std::optional<Packing> read_nearest_packing(const std::filesystem::path& directory, const RecordedReplicate& replicate);

}  // namespace isojam
