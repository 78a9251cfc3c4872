#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/json/json.hpp"
#include "tasks/replicate/summary.hpp"

namespace isojam {

/// A replicate as its directory holds it.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct RecordedReplicate {
  std::string name;  ///< of its files, without extension
  Json record;
  RecordSummary summary;
};

/// What a report is made of.
// NOLINTNEXTLINE(bugprone-exception-escape): as above.
struct Results {
  Json manifest;  ///< as it stands, unchecked; null if there is none that is JSON
  std::vector<RecordedReplicate> replicates;
};

/// Throws FileError if the directory holds no records, InputError for a damaged one.
Results read_results(const std::filesystem::path& directory);

/// The state nearest jamming; nullopt if the directory does not hold it. Throws InputError if it is damaged.
std::optional<Packing> read_nearest_packing(const std::filesystem::path& directory, const std::string& name);

}  // namespace isojam
