#pragma once

#include <span>

#include "engine/solve/jam.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

/// Quantities of the decompression itself, which belong to no measure. They are the numbers of steps and of
/// rearrangements, and three means over rearrangements: the numbers of moved particles, of lost contacts and of gained
/// contacts.
std::span<const Quantity> rearrangement_quantities();

/// Writes these quantities to the record of a replicate. `path` is the list of all its strain steps, see
/// rearrangements().
void put_rearrangements(Json& record, std::span<const JamStep> path);

}  // namespace isojam
