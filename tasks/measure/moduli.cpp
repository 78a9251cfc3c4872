#include "engine/vibration/moduli.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

struct Moduli {
  Reasoned<> K, K_affine, G;
  std::array<Reasoned<>, 5> shear;
  std::optional<Reasoned<>> K_from_pressure;
};

void describe(Fields& field, Moduli& moduli) {
  constexpr QuantityGroup group{"moduli", "Bulk modulus and the five shear moduli, with all particles relaxed."};
  field("K", moduli.K, "Bulk modulus K = V d²E/dV², with all particles relaxed.").unit("Y").column({"K", group, "K"});
  field("K_affine", moduli.K_affine,
        "Bulk modulus (Y) without relaxation: centres follow the strain, and orientations are fixed.")
      .unit("Y");
  field("G", moduli.G, "Mean G of the five shear moduli, with all particles relaxed.")
      .unit("Y")
      .column({"G", group, "G"});
  const auto add = [&](std::size_t k, const char* name, const char* latex, const char* rank) {
    field(name, moduli.shear[k], std::string(rank) + " of the five shear moduli.")
        .unit("Y")
        .column({name, group, latex});
  };
  add(0, "G_min", "G_{min}", "Smallest");
  add(1, "G_2", "G_2", "Second smallest");
  add(2, "G_3", "G_3", "Third smallest");
  add(3, "G_4", "G_4", "Fourth smallest");
  add(4, "G_max", "G_{max}", "Largest");
  field("K_from_pressure", moduli.K_from_pressure,
        "Bulk modulus φ dp/dφ (Y), from the pressures of two neighbouring equilibria. Only the state nearest jamming "
        "has this field.")
      .unit("Y");
}

struct State {
  Moduli moduli;
};
void describe(Fields& field, State& state) {
  field("moduli", state.moduli,
        "Elastic moduli for logarithmic strains of the cell. Apart from `K_from_pressure`, they are null if the "
        "Hessian is not positive definite. Translations and particles without contacts are ignored in this test.");
}

struct Scalings {
  Scaling E, p, K;
};
void describe(Fields& field, Scalings& scaling) {
  add_scaling(field, "E", scaling.E, "E", "E", "E", "Power law of the energy per particle.");
  add_scaling(field, "p", scaling.p, "p", "p", "p", "Power law of the pressure p.");
  add_scaling(field, "K", scaling.K, "K", "K", "K", "Power law of the bulk modulus K.");
}

struct Replicate {
  Scalings scaling;
};
void describe(Fields& field, Replicate& replicate) {
  const auto inside = [&replicate](Fields& inner) {
    inner("scaling", replicate.scaling, "Power laws y ∝ Δφ^x, where y is E, p or K.");
  };
  field.nested("moduli", inside, "Power laws of the energy, the pressure and the bulk modulus as functions of Δφ.");
}

Moduli moduli_of(const std::optional<ElasticTensor>& tensor) {
  constexpr std::string_view no_response = "the Hessian is not positive definite: no response is defined";
  const ElasticTensor of = tensor.value_or(ElasticTensor{});
  const auto value = [&](double modulus) { return given(tensor.has_value(), modulus, no_response); };
  Moduli moduli{value(of.bulk_modulus()), value(of.affine_bulk_modulus()), value(of.mean_shear_modulus()), {}, {}};
  for (std::size_t k = 0; k < moduli.shear.size(); ++k) moduli.shear[k] = value(of.shear_moduli()[k]);
  return moduli;
}

/// K of the nearest state, computed from the slope of the pressure with two more minimisations.
Reasoned<> slope_of(const Packing& packing) {
  const auto slope = pressure_slope(packing);
  return given(slope.has_value(), slope ? slope->bulk_modulus : 0, "a neighbouring density has no equilibrium");
}

Measurement measure_moduli(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  std::vector<std::optional<double>> energies, pressures, bulk;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const Packing& packing = jam.states[k];
    const JamStep& step = jam.path[jam.state_steps[k]];
    const auto here = energy.evaluate(packing, state_precision);
    const auto hessian = energy.hessian(packing, state_precision);
    State state{moduli_of(elastic_tensor(packing, hessian, energy.contacts(packing), here))};
    if (k == nearest) state.moduli.K_from_pressure = slope_of(packing);
    energies.emplace_back(step.energy_per_particle);
    pressures.emplace_back(step.pressure);
    bulk.push_back(state.moduli.K.value);
    measurement.states.push_back(written(state));
  }
  measurement.replicate =
      written(Replicate{{scaling_of(jam, energies), scaling_of(jam, pressures), scaling_of(jam, bulk)}});
  return measurement;
}

}  // namespace

const MeasureDefinition measures::moduli{
    .state = part_of<State>(), .replicate = part_of<Replicate>(), .measure = measure_moduli, .needs_minima = true};

}  // namespace isojam
