#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/store/recorded.hpp"

namespace isojam {

/// A state of an expansion as stored in its directory.
struct StoredState {
  std::size_t index = 0;            ///< in `states` of the record
  std::optional<double> delta_phi;  ///< φ − φ_J; nullopt without a jamming point
  Packing packing;
};

/// The index in `states` of the record of the state nearest jamming. Throws InputError if there is none.
std::size_t index_of_nearest(const std::filesystem::path& directory, const RecordedReplicate& held);

/// For a replicate that did not fail: the state nearest jamming or, with `path`, every state in order. Throws as
/// read_record does, and FileError if the expansion was not kept.
std::vector<StoredState> stored_states(const std::filesystem::path& directory, const RecordedReplicate& held,
                                       bool path);

}  // namespace isojam
