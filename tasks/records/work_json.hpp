#pragma once

#include "engine/solve/jam.hpp"
#include "tasks/io/describe.hpp"

namespace isojam {

// These functions convert the numbers of pairs, the work of minimisations, and rearrangements to and from JSON, for
// records and checkpoints. Each read_… function throws InputError if the JSON does not have the form that to_json()
// writes.

Json to_json(const PairCounts& counts);
PairCounts read_counts(const JsonPlace& place);

Json to_json(const MinimiseWork& work);
MinimiseWork read_work(const JsonPlace& place);

Json to_json(const Rearrangement& rearrangement);
Rearrangement read_rearrangement(const JsonPlace& place);

}  // namespace isojam
