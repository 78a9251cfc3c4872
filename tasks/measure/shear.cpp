#include "engine/shear/shear.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Quasi-static shear of the nearest state, as /shear in the manifest requests it: stress and energy as functions of the
// strain, rearrangements, and the residual strain after unloading.

constexpr QuantityGroup group{"shear",
                              "Quasi-static shear of the state nearest jamming: stiffness, stress drops and yield."};
constexpr auto of_replicate = Quantity::Of::replicate;
constexpr Quantity modulus{"G_shear", "/shear/modulus", group, "Y", "G_{shear}", of_replicate};
constexpr Quantity drops{"shear_drops", "/shear/drops", group, "1", "n_{drops}", of_replicate};
constexpr Quantity yield_strain{"yield_strain", "/shear/yield_strain", group, "1", "\\gamma_y", of_replicate};
constexpr Quantity peak{"peak_stress", "/shear/peak_stress", group, "1", "s_{max}/p", of_replicate};
constexpr Quantity returned{"energy_returned", "/shear/energy_returned", group, "1", "E_{back}/E", of_replicate};
constexpr std::array quantities{modulus, drops, yield_strain, peak, returned};

Json state_record(const ShearState& state, int particles) {
  Json json;
  put_number(json, "load", state.load);
  put_number(json, "strain", state.strain);
  put_number(json, "stress", state.stress);
  put_number(json, "phi", state.packing.density());
  put_number(json, "pressure", state.pressure);
  put_number(json, "energy_per_particle", state.energy / particles);
  put_number(json, "Z", 2.0 * static_cast<double>(state.contacts) / particles);
  PackingEnergy energy;
  const auto classified = classified_contacts(state.packing, energy);
  const auto undecided_why = undecided(classified.analysis);
  put_optional(json, "C", undecided_why ? std::nullopt : std::optional(classified.analysis.numbers.C),
               undecided_why.value_or(""));
  put_number(json, "dissipated_per_particle", state.dissipated / particles);
  json["dropped"] = state.dropped;
  json["descents"] = state.descents;
  put_number(json, "residual", state.summary.residual);
  json["stopped"] = to_string(state.summary.reason);
  return json;
}

void put_summary(Json& replicate, const ShearResult& result, const ShearOptions& options) {
  const auto& states = result.states;
  const auto dropped = std::find_if(states.begin(), states.end(), [](const ShearState& s) { return s.dropped; });
  const bool answered = states.size() > 1 && states[1].strain != states[0].strain;
  const bool linear = answered && !states[1].dropped;
  put(replicate, modulus,
      linear ? std::optional((states[1].stress - states[0].stress) / (states[1].strain - states[0].strain))
             : std::nullopt,
      answered ? "the first step was a drop" : "no step");
  put(replicate, drops, std::count_if(states.begin(), states.end(), [](const ShearState& s) { return s.dropped; }));
  put(replicate, yield_strain, dropped != states.end() ? std::optional(std::prev(dropped)->strain) : std::nullopt,
      "no drop on the way");
  double largest = 0;
  for (const auto& state : states) largest = std::max(largest, std::abs(state.stress) / state.pressure);
  put(replicate, peak, largest);
  const bool back = options.back && result.ended == ShearEnd::completed;
  put(replicate, returned, back ? std::optional(states.back().energy / states.front().energy) : std::nullopt,
      options.back ? "the load did not come back" : "the load was not taken back");
}

Json nothing_sheared(std::string_view why) {
  Json replicate;
  for (const auto& quantity : quantities) put(replicate, quantity, std::nullopt, why);
  replicate["shear"]["ended"] = to_string(ShearEnd::not_called);
  replicate["shear"]["path"] = Json::array();
  return replicate;
}

Measurement measure_shear(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  measurement.states.assign(jam.states.size(), Json::object());
  const auto nearest = nearest_state(jam);
  if (!nearest) return measurement;
  PackingEnergy energy;
  if (const auto why = not_jammed(jam.states[*nearest], energy)) {
    measurement.replicate = nothing_sheared(*why);
    return measurement;
  }
  const auto result = shear(jam.states[*nearest], options.shear);
  Json& json = measurement.replicate["shear"];
  json["ended"] = to_string(result.ended);
  json["path"] = Json::array();
  for (const auto& state : result.states) json["path"].push_back(state_record(state, state.packing.size()));
  put_summary(measurement.replicate, result, options.shear);
  return measurement;
}

}  // namespace

const MeasureDefinition measures::shear{.quantities = quantities, .measure = measure_shear, .needs_minima = true};

}  // namespace isojam
