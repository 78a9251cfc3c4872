#pragma once

#include <vector>

#include "tasks/json/place.hpp"
#include "tasks/replicate/replicate.hpp"

namespace isojam {

/// The result that a record and the packings of its path were made of, bit for bit in all that measures and records
/// read of it. `record` of a replicate without failure, `states` all packings of its path. Throws InputError if they do
/// not fit together.
JamResult restored_jam(const JsonPlace& record, std::vector<Packing> states, const ReplicateSpec& spec);

}  // namespace isojam
