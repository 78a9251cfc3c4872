#include "engine/vibration/moduli.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

constexpr QuantityGroup group{"moduli", "Bulk modulus and the five shear moduli, with all particles relaxed."};
constexpr Quantity K{"K", "/moduli/K", group, "Y", "K"}, G{"G", "/moduli/G", group, "Y", "G"};
constexpr Quantity G_min{"G_min", "/moduli/G_min", group, "Y", "G_{min}"};
constexpr Quantity G_2{"G_2", "/moduli/G_2", group, "Y", "G_2"}, G_3{"G_3", "/moduli/G_3", group, "Y", "G_3"};
constexpr Quantity G_4{"G_4", "/moduli/G_4", group, "Y", "G_4"};
constexpr Quantity G_max{"G_max", "/moduli/G_max", group, "Y", "G_{max}"};
constexpr Quantity x_E{"x_E", "/moduli/scaling/E/exponent", exponent_group, "1", "x_E", Quantity::Of::replicate};
constexpr Quantity x_p{"x_p", "/moduli/scaling/p/exponent", exponent_group, "1", "x_p", Quantity::Of::replicate};
constexpr Quantity x_K{"x_K", "/moduli/scaling/K/exponent", exponent_group, "1", "x_K", Quantity::Of::replicate};
constexpr std::array quantities{K, G, G_min, G_2, G_3, G_4, G_max, x_E, x_p, x_K};

constexpr std::string_view no_response = "the Hessian is not positive definite: no response is defined";

Json moduli_record(const std::optional<ElasticTensor>& tensor) {
  Json state;
  const auto value = [&](const auto& value_of) {
    return tensor ? std::optional<double>(value_of(*tensor)) : std::nullopt;
  };
  Json& json = state["moduli"];
  put(state, K, value([](const ElasticTensor& t) { return t.bulk_modulus(); }), no_response);
  put_optional(json, "K_affine", value([](const ElasticTensor& t) { return t.affine_bulk_modulus(); }), no_response);
  put(state, G, value([](const ElasticTensor& t) { return t.mean_shear_modulus(); }), no_response);
  std::size_t place = 0;
  for (const Quantity& quantity : {G_min, G_2, G_3, G_4, G_max}) {
    put(state, quantity, value([place](const ElasticTensor& t) { return t.shear_moduli()[place]; }), no_response);
    ++place;
  }
  return state;
}

/// Adds K of the nearest state, computed from the slope of the pressure with two more minimisations.
void put_slope(Json& json, const Packing& packing) {
  const auto slope = pressure_slope(packing);
  put_optional(json, "K_from_pressure", slope ? std::optional(slope->bulk_modulus) : std::nullopt,
               "a neighbouring density has no equilibrium");
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
    const auto tensor = elastic_tensor(packing, hessian, energy.contacts(packing), here);
    auto state = moduli_record(tensor);
    if (k == nearest) put_slope(state["moduli"], packing);
    energies.emplace_back(step.energy_per_particle);
    pressures.emplace_back(step.pressure);
    bulk.push_back(tensor ? std::optional(tensor->bulk_modulus()) : std::nullopt);
    measurement.states.push_back(std::move(state));
  }
  put_scaling(measurement.replicate, x_E, jam, energies);
  put_scaling(measurement.replicate, x_p, jam, pressures);
  put_scaling(measurement.replicate, x_K, jam, bulk);
  return measurement;
}

}  // namespace

const MeasureDefinition measures::moduli{.quantities = quantities, .measure = measure_moduli, .needs_minima = true};

}  // namespace isojam
