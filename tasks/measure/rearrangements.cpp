#include "tasks/measure/rearrangements.hpp"

#include <array>

#include "engine/solve/rearrangement.hpp"

namespace isojam {
namespace {

constexpr QuantityGroup group{"rearrangements", "Rearrangements between the states of the decompression."};
constexpr auto of = Quantity::Of::replicate;
constexpr Quantity rearrangement_count{"rearrangements", "/rearrangements/count", group, "1", "n_r", of};
constexpr Quantity expansion_steps{"expansion_steps", "/rearrangements/steps", group, "1", "n_s", of};
constexpr Quantity particles_moved{"particles_moved", "/rearrangements/particles_moved", group, "1", "N_m", of};
constexpr Quantity contacts_lost{"contacts_lost", "/rearrangements/contacts_lost", group, "1", "n_-", of};
constexpr Quantity contacts_gained{"contacts_gained", "/rearrangements/contacts_gained", group, "1", "n_+", of};
constexpr std::array quantities{rearrangement_count, expansion_steps, particles_moved, contacts_lost, contacts_gained};

}  // namespace

std::span<const Quantity> rearrangement_quantities() { return quantities; }

void put_rearrangements(Json& record, std::span<const JamStep> path) {
  const auto found = rearrangements(path);
  put(record, rearrangement_count, found.is_rearranged);
  put(record, expansion_steps, found.steps);
  constexpr std::string_view none = "the packing gave way in no step that led to another equilibrium";
  put(record, particles_moved, found.particles_moved, none);
  put(record, contacts_lost, found.contacts_lost, none);
  put(record, contacts_gained, found.contacts_gained, none);
}

}  // namespace isojam
