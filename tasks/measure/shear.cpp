#include "engine/shear/shear.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Quasi-static shear of the nearest state, as /shear in the manifest requests it: stress and energy as functions of the
// strain, rearrangements, and the residual strain after unloading.

struct Step {
  double load = 0, strain = 0, stress = 0, density = 0, pressure = 0, energy_per_particle = 0, Z = 0;
  Reasoned<> C;
  double dissipated_per_particle = 0;
  bool dropped = false;
  int descents = 0;
  double residual = 0;
  StopReason stopped = StopReason::not_called;
};
void describe(Fields& field, Step& step) {
  field("load", step.load,
        "Prescribed value in this state: the shear strain γ, or, if the stress is prescribed, the shear stress s "
        "divided by the initial pressure.")
      .finite();
  field("strain", step.strain, "Shear strain γ.").finite();
  field("stress", step.stress, "Shear stress s (Y), with dE = V s dγ.").unit("Y").finite();
  field("density", step.density, "Density φ.").finite();
  field("pressure", step.pressure, "Pressure p (Y).").unit("Y").finite();
  field("energy_per_particle", step.energy_per_particle, "Energy per particle E/N (Y·V_p).").unit("Y·V_p").finite();
  field("Z", step.Z, "Contact number: number of contacts per particle; each contact counts for both of its particles.")
      .range(not_negative)
      .finite();
  field("C", step.C,
        "Constraint number C, with cut-offs fitted to this state: number of constraints per particle; each contact "
        "counts for both of its particles. Null if the fit of θ_ff or of θ_ef found no cut-off.");
  field("dissipated_per_particle", step.dissipated_per_particle,
        "Energy per particle (Y·V_p) that was dissipated in the step to this state: the work of the shear minus the "
        "increase of the energy.")
      .unit("Y·V_p")
      .finite();
  field("dropped", step.dropped, "True if the step to this state was a drop.");
  field("descents", step.descents,
        "Number of saddles that were relaxed along a negative mode before this state was reached.");
  field("residual", step.residual,
        "Residual: the greater of two numbers, divided by the mean contact force. The numbers are the largest net "
        "force on a particle, and the largest net torque divided by R.");
  field("stopped", step.stopped, "Reason for the end of the minimisation.");
}

struct Shear {
  ShearEnd ended = ShearEnd::not_called;
  std::vector<Step> path;
  Reasoned<> modulus;
  Reasoned<long> drops;
  Reasoned<> yield_strain, peak_stress, energy_returned;
};
void describe(Fields& field, Shear& shear) {
  constexpr QuantityGroup group{"shear",
                                "Quasi-static shear of the state nearest jamming: stiffness, stress drops and yield."};
  field("ended", shear.ended,
        "Reason for the end of the shear. `not_called`: Nothing was sheared, because the state nearest jamming has no "
        "pressure, or its forces do not balance. `completed`: All requested steps were made. `no_equilibrium`: A step "
        "found no equilibrium. `unjammed`: The packing lost its contact forces. `cell_limit`: The cell became too skew "
        "or too small. `interrupted`: The program was interrupted.");
  field("path", shear.path, "Equilibria during the shear. The first is the state nearest jamming, before the shear.")
      .detail();
  field("modulus", shear.modulus,
        "Shear modulus from the first shear step: the change of the shear stress divided by the change of the shear "
        "strain; null if this step was a drop.")
      .unit("Y")
      .column({"G_shear", group, "G_{shear}"});
  field("drops", shear.drops,
        "Number of drops: shear steps that reached a saddle, or that dissipated more than 1 % of the energy of the "
        "packing.")
      .column({"shear_drops", group, "n_{drops}"});
  field("yield_strain", shear.yield_strain,
        "Shear strain γ of the last state before the first drop; null if there was no drop.")
      .column({"yield_strain", group, "\\gamma_y"});
  field("peak_stress", shear.peak_stress,
        "Largest value of |s|/p during the shear, where s is the shear stress and p the pressure.")
      .range(not_negative)
      .column({"peak_stress", group, "s_{max}/p"});
  field("energy_returned", shear.energy_returned,
        "Energy after the shear was reduced to zero again, divided by the energy before the shear; null if "
        "`spec.shear.back` is false, or if the shear was not completed.")
      .column({"energy_returned", group, "E_{back}/E"});
}

struct Replicate {
  std::optional<Shear> shear;
};
void describe(Fields& field, Replicate& replicate) {
  field("shear", replicate.shear,
        "Quasi-static shear of the state nearest jamming, with the settings in `spec.shear`.");
}

Step step_record(const ShearState& state) {
  const int particles = state.packing.size();
  PackingEnergy energy;
  const auto classified = classified_contacts(state.packing, energy);
  const auto why = undecided(classified.analysis);
  return {state.load,
          state.strain,
          state.stress,
          state.packing.density(),
          state.pressure,
          state.energy / particles,
          2.0 * static_cast<double>(state.contacts) / particles,
          given(!why, classified.analysis.numbers.C, why.value_or("")),
          state.dissipated / particles,
          state.dropped,
          state.descents,
          state.summary.residual,
          state.summary.reason};
}

Shear shear_record(const ShearResult& result, const ShearOptions& options) {
  const auto& states = result.states;
  const auto is_drop = [](const ShearState& state) { return state.dropped; };
  const auto dropped = std::find_if(states.begin(), states.end(), is_drop);
  const bool answered = states.size() > 1 && states[1].strain != states[0].strain;
  const bool linear = answered && !states[1].dropped;
  const bool back = options.back && result.ended == ShearEnd::completed;
  double largest = 0;
  for (const auto& state : states) largest = std::max(largest, std::abs(state.stress) / state.pressure);
  Shear record;
  record.ended = result.ended;
  for (const auto& state : states) record.path.push_back(step_record(state));
  record.modulus =
      given(linear, linear ? (states[1].stress - states[0].stress) / (states[1].strain - states[0].strain) : 0,
            answered ? "the first step was a drop" : "no step");
  record.drops.value = std::count_if(states.begin(), states.end(), is_drop);
  record.yield_strain =
      given(dropped != states.end(), dropped != states.end() ? std::prev(dropped)->strain : 0, "no drop on the way");
  record.peak_stress.value = largest;
  record.energy_returned = given(back, back ? states.back().energy / states.front().energy : 0,
                                 options.back ? "the load did not come back" : "the load was not taken back");
  return record;
}

Shear nothing_sheared(std::string_view why) {
  Shear record;
  for (auto* value : {&record.modulus, &record.yield_strain, &record.peak_stress, &record.energy_returned})
    value->reason = why;
  record.drops.reason = why;
  return record;
}

Measurement measure_shear(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  measurement.states.assign(jam.states.size(), Json::object());
  const auto nearest = nearest_state(jam);
  if (!nearest) return measurement;
  PackingEnergy energy;
  const auto& packing = jam.states[*nearest];
  const auto why = not_jammed(packing, energy);
  measurement.replicate =
      written(Replicate{why ? nothing_sheared(*why) : shear_record(shear(packing, options.shear), options.shear)});
  return measurement;
}

}  // namespace

const MeasureDefinition measures::shear{
    .replicate = part_of<Replicate>(), .measure = measure_shear, .needs_minima = true};

}  // namespace isojam
