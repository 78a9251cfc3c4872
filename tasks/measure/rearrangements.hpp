#pragma once

#include <span>

#include "engine/solve/jam.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

/// Quantities of the decompression itself, which belong to no measure: the number of rearrangements, the number of
/// steps, and means over rearrangements of the number of particles that moved and of the numbers of contacts that were
/// lost and gained.
std::span<const Quantity> rearrangement_quantities();

/// Writes these quantities to the record of a replicate. `path` is the list of all its strain steps, see
/// rearrangements().
void put_rearrangements(Json& record, std::span<const JamStep> path);

}  // namespace isojam
