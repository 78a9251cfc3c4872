#pragma once

#include "engine/solve/jam.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

// What records and checkpoints say of the work behind a result, in both directions. Readers throw InputError for what
// was not written so.

Json to_json(const PairCounts& counts);
PairCounts read_counts(const JsonPlace& place);

Json to_json(const MinimiseWork& work);
MinimiseWork read_work(const JsonPlace& place);

Json to_json(const Rearrangement& rearrangement);
Rearrangement read_rearrangement(const JsonPlace& place);

}  // namespace isojam
