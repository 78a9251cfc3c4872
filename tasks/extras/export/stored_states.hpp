#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/records/recorded.hpp"

namespace isojam {

/// A state that is stored in a results directory.
struct StoredState {
  std::size_t index = 0;            ///< index of the state in the list `states` of the record
  std::optional<double> delta_phi;  ///< φ − φ_J; nullopt if the record has no φ_J
  Packing packing;
  /// exponents of its contacts (analysis/exponents.hpp); empty if the record does not have them
  std::vector<std::optional<double>> exponents;
  double gap = 0;  ///< pairs with a smaller gap count as contacts; only in packings as given
};

/// Reads the nearest state of a replicate. If `path` is true, reads all states of its path, in order. The replicate
/// must not have failed. Throws InputError if a file is missing, for example because the path was not kept, or if it is
/// damaged or belongs to another record. Throws FileError if a file cannot be read at the moment.
std::vector<StoredState> stored_states(const std::filesystem::path& directory, const RecordedReplicate& held,
                                       bool path);

}  // namespace isojam
