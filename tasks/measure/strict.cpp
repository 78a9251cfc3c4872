#include "engine/vibration/strict.hpp"

#include "engine/solve/rearrangement.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Tests whether states are strictly jammed: uses the second derivatives of the enthalpy with respect to the particles
// and all six strains of the cell, at the pressure of the state. Also relaxes the cell of the nearest state.

constexpr QuantityGroup group{"strict jamming",
                              "Stability of the packing if the shape and the volume of the cell may change."};
constexpr Quantity strictly_jammed = proportion({"strictly_jammed", "/strict/jammed", group, "1", "n_{strict}"});
constexpr Quantity negative{"strict_negative", "/strict/negative", group, "1", "n_-^{strict}"};
constexpr Quantity deviator{"deviator", "/strict/deviator", group, "1", "\\max|\\sigma+p|/p"};
constexpr auto of_replicate = Quantity::Of::replicate;
constexpr Quantity freed_jammed =
    proportion({"freed_jammed", "/strict/freed/jammed", group, "1", "n_{freed}", of_replicate});
constexpr Quantity freed_strain{"freed_strain", "/strict/freed/strain", group, "1", "\\epsilon_{freed}", of_replicate};
constexpr Quantity freed_phi_j{"freed_phi_j", "/strict/freed/phi_j", group, "1", "\\phi_J^{freed}", of_replicate};
constexpr std::array quantities{strictly_jammed, negative, deviator, freed_jammed, freed_strain, freed_phi_j};

constexpr std::string_view no_verdict = "inertia could not be had",
                           no_freed = "no equilibrium was found in a free cell";

Json strict_record(const Packing& packing, PackingEnergy& energy) {
  Json state;
  const auto here = energy.evaluate(packing, state_precision);
  const auto stability = strict_stability(packing, here, state_precision);
  const bool known = stability.verdict != Verdict::undetermined;
  const auto value = [&](double x) { return known ? std::optional(x) : std::nullopt; };
  put(state, strictly_jammed, value(is_strictly_jammed(stability)), no_verdict);
  put(state, negative, value(stability.negative), no_verdict);
  put_optional(state["strict"], "zero", value(stability.zero), no_verdict);
  put_number(state["strict"], "tolerance", stability.tolerance);
  put(state, deviator, deviator_of(here));
  return state;
}

Json nothing_freed(std::string_view why) {
  Json replicate;
  for (const auto& quantity : {freed_jammed, freed_strain, freed_phi_j}) put(replicate, quantity, std::nullopt, why);
  Json& json = replicate["strict"]["freed"];
  json["ended"] = to_string(MinimumSearchEnd::not_called);
  json["stopped"] = to_string(StopReason::not_called);
  put_absent(json, "phi", why);
  put_absent(json, "deviator", why);
  json["negative"] = json["descents"] = 0;
  return replicate;
}

Json freed_record(const Packing& packing, const JamStep& step, PackingEnergy& energy) {
  if (const auto why = not_jammed(packing, energy)) return nothing_freed(*why);
  Json replicate;
  const auto freed = free_cell(packing, distance_to_jamming(step));
  const bool found = is_equilibrium(freed.result.summary);
  const auto value = [&](double x) { return found ? std::optional(x) : std::nullopt; };
  put(replicate, freed_jammed, value(is_strictly_jammed(freed.result.stability)), no_freed);
  put(replicate, freed_strain, value(freed.strain), no_freed);
  JamStep after;
  after.density = freed.density;
  after.energy_per_particle = freed.energy_per_particle;
  after.pressure = freed.pressure;
  const auto phi_j =
      found && freed.pressure > 0 ? std::optional(freed.density - distance_to_jamming(after)) : std::nullopt;
  put(replicate, freed_phi_j, phi_j, no_freed);
  Json& json = replicate["strict"]["freed"];
  json["ended"] = to_string(freed.result.ended);
  json["stopped"] = to_string(freed.result.summary.reason);
  put_number(json, "phi", freed.density);
  put_number(json, "deviator", freed.deviator);
  json["negative"] = freed.result.stability.negative;
  json["descents"] = freed.result.descents;
  return replicate;
}

Measurement measure_strict(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) measurement.states.push_back(strict_record(packing, energy));
  const auto nearest = nearest_state(jam);
  if (nearest) measurement.replicate = freed_record(jam.states[*nearest], jam.path[jam.state_steps[*nearest]], energy);
  return measurement;
}

}  // namespace

const MeasureDefinition measures::strict{.quantities = quantities, .measure = measure_strict, .needs_minima = true};

}  // namespace isojam
