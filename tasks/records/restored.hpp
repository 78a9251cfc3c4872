#pragma once

#include <string>
#include <vector>

#include "tasks/records/document.hpp"

namespace isojam {

/// Restores the JamResult from which a record was written. Everything that measures and records use has the same bits
/// as in the original. The replicate must not have failed. `states` are all packings of its path. Throws InputError
/// with the name `file` if the record and the states do not belong together.
JamResult restored_jam(const Record& record, std::vector<Packing> states, const ReplicateSpec& spec,
                       const std::string& file);

}  // namespace isojam
