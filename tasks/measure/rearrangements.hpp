#pragma once

#include <span>

#include "engine/solve/jam.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

/// Quantities of the decompression itself, which belong to no measure: the number of rearrangements, the number of
/// steps, the number of particles that moved, and the numbers of contacts that were lost and gained.
std::span<const Quantity> rearrangement_quantities();

/// Writes these quantities to the record of a replicate with this path; see rearrangements() of the engine.
void put_rearrangements(Json& record, std::span<const JamStep> path);

}  // namespace isojam
