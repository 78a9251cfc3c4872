#include "tasks/measure/rearrangements.hpp"

#include "engine/solve/rearrangement.hpp"

namespace isojam {

void describe(Fields& field, RearrangementCounts& counts) {
  constexpr QuantityGroup group{"rearrangements", "Rearrangements between the states of the decompression."};
  field("count", counts.count, "Number of rearrangements in the decompression.")
      .column({"rearrangements", group, "n_r"});
  field("steps", counts.steps,
        "Number of decompression steps that reached the next equilibrium, or in which the solution branch ended. Steps "
        "that failed and were repeated are not counted.")
      .column({"decompression_steps", group, "n_s"});
  field("particles_moved", counts.particles_moved,
        "Mean number of particles that moved in a rearrangement. Rearrangements in which the solution branch ended are "
        "left out.")
      .range(not_negative)
      .column({"particles_moved", group, "N_m"});
  field("contacts_lost", counts.contacts_lost,
        "Mean number of contacts that were lost in a rearrangement. Rearrangements in which the solution branch ended "
        "are left out.")
      .range(not_negative)
      .column({"contacts_lost", group, "n_-"});
  field("contacts_gained", counts.contacts_gained,
        "Mean number of contacts that were gained in a rearrangement. Rearrangements in which the solution branch "
        "ended are left out.")
      .range(not_negative)
      .column({"contacts_gained", group, "n_+"});
}

void describe(Fields& field, RearrangementPart& part) {
  field("rearrangements", part.rearrangements,
        "Rearrangements in the decompression. A decompression step is a rearrangement if the energy after it is less "
        "than half of the value that E ∝ Δφ⁶ predicts, or if the solution branch ends in it.");
}

RearrangementPart rearrangement_part(std::span<const JamStep> path) {
  const auto found = rearrangements(path);
  constexpr std::string_view none = "the packing gave way in no step that led to another equilibrium";
  return {{found.count, found.steps, reasoned(found.particles_moved, none), reasoned(found.contacts_lost, none),
           reasoned(found.contacts_gained, none)}};
}

}  // namespace isojam
