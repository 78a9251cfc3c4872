#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/records/recorded.hpp"

namespace isojam {

/// A state of a decompression that is stored in a results directory.
struct StoredState {
  std::size_t index = 0;            ///< index of the state in the list `states` of the record
  std::optional<double> delta_phi;  ///< φ − φ_J; nullopt without a jamming point
  Packing packing;
};

/// Index of the state nearest jamming in the list `states` of the record. Throws InputError if there is none.
std::size_t index_of_nearest(const std::filesystem::path& directory, const RecordedReplicate& held);

/// Reads the state nearest jamming of a replicate, or all states in order if `path` is true. The replicate must not
/// have failed. Throws the same exceptions as read_record(), and FileError if the path was not kept.
std::vector<StoredState> stored_states(const std::filesystem::path& directory, const RecordedReplicate& held,
                                       bool path);

}  // namespace isojam
