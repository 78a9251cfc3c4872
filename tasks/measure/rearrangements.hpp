#pragma once

#include <span>

#include "engine/solve/jam.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

/// Quantities of the expansion itself, which need no measure: the number of rearrangements, the steps that they took,
/// the particles that moved, and the contacts lost and gained.
std::span<const Quantity> rearrangement_quantities();

/// Writes them to the record of a replicate with this path; see rearrangements() of the engine.
void put_rearrangements(Json& record, std::span<const JamStep> path);

}  // namespace isojam
