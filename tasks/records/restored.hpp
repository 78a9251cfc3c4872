#pragma once

#include <vector>

#include "tasks/io/place.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam {

/// Restores the JamResult from which a record was written. Everything that measures and records use has the same bits
/// as in the original. The replicate must not have failed. `states` are all packings of its path. Throws InputError if
/// the record and the states do not belong together.
JamResult restored_jam(const JsonPlace& record, std::vector<Packing> states, const ReplicateSpec& spec);

}  // namespace isojam
