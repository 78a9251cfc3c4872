#pragma once

#include <span>

#include "engine/solve/jam.hpp"
#include "tasks/io/describe.hpp"

namespace isojam {

/// Quantities of the decompression itself, which belong to no measure.
struct RearrangementCounts {
  int count = 0, steps = 0;
  Reasoned<> particles_moved, contacts_lost, contacts_gained;
};
void describe(Fields& field, RearrangementCounts& counts);

/// What they add to the record of a replicate.
struct RearrangementPart {
  RearrangementCounts rearrangements;
};
void describe(Fields& field, RearrangementPart& part);

/// `path` is the list of all strain steps of a replicate, see rearrangements().
RearrangementPart rearrangement_part(std::span<const JamStep> path);

}  // namespace isojam
