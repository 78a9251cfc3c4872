#include "engine/vibration/strict.hpp"

#include "engine/solve/rearrangement.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Tests whether states are strictly jammed: uses the second derivatives of the enthalpy with respect to the particles
// and all six strains of the cell, at the pressure of the state. Also relaxes the cell of the nearest state.

constexpr QuantityGroup group{"strict jamming",
                              "Stability of the packing if the shape and the volume of the cell may change."};
constexpr const char* meaning_of_deviator =
    "Deviation of the stress from hydrostatic stress: the largest absolute entry of the matrix σ + p·1, divided by p.";

struct Strict {
  Reasoned<> jammed, negative, zero;
  double tolerance = 0, deviator = 0;
};
void describe(Fields& field, Strict& strict) {
  field("jammed", strict.jammed,
        "1 if the state is strictly jammed, 0 if not. It is strictly jammed if the particles and the six strains of "
        "the cell together have no negative mode and at most 3 + 6n zero modes. The zero modes include the three "
        "translations, and n is the number of near-rattlers.")
      .column({.name = "strictly_jammed", .group = group, .latex = "n_{strict}", .proportion = true});
  field("negative", strict.negative, "Number of negative modes of the particles and the six strains together.")
      .range(not_negative)
      .column({"strict_negative", group, "n_-^{strict}"});
  field("zero", strict.zero,
        "Number of zero modes of the particles and the six strains together, including the three translations.")
      .range(not_negative);
  field("tolerance", strict.tolerance,
        "An eigenvalue λ counts as zero if |λ| is at most this value, in units of (Y/ρ)·V_p^(-2/3).")
      .finite();
  field("deviator", strict.deviator, meaning_of_deviator)
      .range(not_negative)
      .finite()
      .column({"deviator", group, "\\max|\\sigma+p|/p"});
}

struct State {
  Strict strict;
};
void describe(Fields& field, State& state) {
  field("strict", state.strict,
        "Modes of the particles and the six strains of the cell together, for the enthalpy E + p·V_cell at the "
        "pressure p of the state.");
}

struct Freed {
  Reasoned<> jammed, strain, phi_j;
  MinimumSearchEnd ended = MinimumSearchEnd::not_called;
  StopReason stopped = StopReason::not_called;
  Reasoned<> density, deviator;
  int negative = 0, descents = 0;
};
void describe(Fields& field, Freed& freed) {
  field("jammed", freed.jammed,
        "1 if the state nearest jamming is strictly jammed after its cell was relaxed, 0 if not; null if the "
        "relaxation found no equilibrium.")
      .column({.name = "freed_jammed", .group = group, .latex = "n_{freed}", .proportion = true});
  field("strain", freed.strain,
        "Strain |½(FᵀF − 1)| that results when the cell of the state nearest jamming is relaxed; F is the deformation "
        "of the cell.")
      .range(not_negative)
      .column({"freed_strain", group, "\\epsilon_{freed}"});
  field("phi_j", freed.phi_j,
        "Estimate of φ_J from the state nearest jamming after its cell was relaxed: φ − 6E/(dE/dφ).")
      .column({"freed_phi_j", group, "\\phi_J^{freed}"});
  field("ended", freed.ended,
        "Reason for the end of the relaxation. `was_minimum`: The first equilibrium had no negative mode. "
        "`reached_minimum`: Saddles were relaxed along negative modes to a minimum. `lost_balance`: A minimisation "
        "found no equilibrium. `still_unstable`: A negative mode remains after five saddles, or no lower energy was "
        "found along the mode. `undetermined`: The modes could not be computed or counted. `not_called`: Nothing was "
        "relaxed, because the state nearest jamming has no pressure, or its forces do not balance.");
  field("stopped", freed.stopped, "Reason for the end of the last minimisation.");
  field("density", freed.density, "Density φ after the relaxation.");
  field("deviator", freed.deviator, meaning_of_deviator).range(not_negative);
  field("negative", freed.negative,
        "Number of negative modes of the particles and the six strains together, after the relaxation.");
  field("descents", freed.descents, "Number of saddles that were relaxed along a negative mode.");
}

struct StrictOfReplicate {
  Freed freed;
};
void describe(Fields& field, StrictOfReplicate& strict) {
  field("freed", strict.freed,
        "Result of relaxing the shape and volume of the cell of the state nearest jamming at constant pressure.");
}

struct Replicate {
  std::optional<StrictOfReplicate> strict;
};
void describe(Fields& field, Replicate& replicate) {
  field("strict", replicate.strict, "Test of strict jamming of the state nearest jamming, after its cell was relaxed.");
}

Strict strict_record(const Packing& packing, PackingEnergy& energy) {
  const auto here = energy.evaluate(packing, state_precision);
  const auto stability = strict_stability(packing, here, state_precision);
  const bool known = stability.verdict != Verdict::undetermined;
  const auto value = [&](double x) { return given(known, x, "inertia could not be had"); };
  return {value(is_strictly_jammed(stability)), value(stability.negative), value(stability.zero), stability.tolerance,
          deviator_of(here)};
}

Freed freed_record(const Packing& packing, const JamStep& step, PackingEnergy& energy) {
  Freed record;
  if (const auto why = not_jammed(packing, energy)) {
    for (auto* value : {&record.jammed, &record.strain, &record.phi_j, &record.density, &record.deviator})
      value->reason = *why;
    return record;
  }
  const auto freed = free_cell(packing, distance_to_jamming(step));
  const bool found = is_equilibrium(freed.result.summary);
  const auto value = [&](bool known, double x) { return given(known, x, "no equilibrium was found in a free cell"); };
  JamStep after;
  after.density = freed.density;
  after.energy_per_particle = freed.energy_per_particle;
  after.pressure = freed.pressure;
  const bool has_distance = found && freed.pressure > 0;
  return {value(found, is_strictly_jammed(freed.result.stability)),
          value(found, freed.strain),
          value(has_distance, has_distance ? freed.density - distance_to_jamming(after) : 0),
          freed.result.ended,
          freed.result.summary.reason,
          {freed.density, ""},
          {freed.deviator, ""},
          freed.result.stability.negative,
          freed.result.descents};
}

Measurement measure_strict(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states)
    measurement.states.push_back(written(State{strict_record(packing, energy)}));
  Replicate replicate;
  if (const auto nearest = nearest_state(jam))
    replicate.strict = {freed_record(jam.states[*nearest], jam.path[jam.state_steps[*nearest]], energy)};
  measurement.replicate = written(replicate);
  return measurement;
}

}  // namespace

const MeasureDefinition measures::strict{
    .state = part_of<State>(), .replicate = part_of<Replicate>(), .measure = measure_strict, .needs_minima = true};

}  // namespace isojam
