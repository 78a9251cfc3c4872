#pragma once

#include <span>

#include "engine/solve/jam.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

/// What the expansion itself tells of a replicate, whatever is measured: how often the packing gave way on it, in how
/// many steps, and of these events the particles that moved and the contacts lost and gained.
std::span<const Quantity> rearrangement_quantities();

/// Writes them into the record of a replicate that took this path; see rearrangements() of the engine.
void put_rearrangements(Json& record, std::span<const JamStep> path);

}  // namespace isojam
