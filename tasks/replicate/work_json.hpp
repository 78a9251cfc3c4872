#pragma once

#include "engine/solve/jam.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

// The work behind a result as JSON, for records and checkpoints. Readers throw InputError for anything else than a
// writer writes.

Json to_json(const PairCounts& counts);
PairCounts read_counts(const JsonPlace& place);

Json to_json(const MinimiseWork& work);
MinimiseWork read_work(const JsonPlace& place);

Json to_json(const Rearrangement& rearrangement);
Rearrangement read_rearrangement(const JsonPlace& place);

}  // namespace isojam
