#include "engine/vibration/moduli.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

constexpr std::string_view no_response = "the Hessian is not positive definite: no response is defined";

Json moduli_record(const std::optional<ElasticTensor>& tensor) {
  Json json;
  const auto put = [&](const std::string& key, const auto& value_of) {
    put_optional(json, key, tensor ? std::optional<double>(value_of(*tensor)) : std::nullopt, no_response);
  };
  put("K", [](const ElasticTensor& t) { return t.bulk_modulus(); });
  put("K_affine", [](const ElasticTensor& t) { return t.affine_bulk_modulus(); });
  put("G", [](const ElasticTensor& t) { return t.mean_shear_modulus(); });
  put("G_min", [](const ElasticTensor& t) { return t.shear_moduli().front(); });
  put("G_max", [](const ElasticTensor& t) { return t.shear_moduli().back(); });
  return json;
}

/// K as the slope of the pressure, at the state nearest jamming: two more minimisations.
void put_slope(Json& json, const Packing& packing) {
  const auto slope = pressure_slope(packing);
  put_optional(json, "K_from_pressure", slope ? std::optional(slope->bulk_modulus) : std::nullopt,
               "a neighbouring density has no equilibrium");
}

}  // namespace

Measurement measure_moduli(const JamResult& jam) {
  Measurement measurement;
  PackingEnergy energy;
  std::vector<std::optional<double>> energies, pressures, bulk;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const Packing& packing = jam.states[k];
    const JamStep& step = jam.path[jam.state_steps[k]];
    const auto here = energy.evaluate(packing, step.summary.precision);
    const auto hessian = energy.hessian(packing, step.summary.precision);
    const auto tensor = elastic_tensor(packing, hessian, energy.contacts(packing), here);
    auto json = moduli_record(tensor);
    if (k == nearest) put_slope(json, packing);
    energies.emplace_back(step.energy_per_particle);
    pressures.emplace_back(step.pressure);
    bulk.push_back(tensor ? std::optional(tensor->bulk_modulus()) : std::nullopt);
    measurement.states.push_back({{"moduli", std::move(json)}});
  }
  measurement.replicate["moduli_scaling"] = {
      {"E", scaling_record(jam, energies)}, {"p", scaling_record(jam, pressures)}, {"K", scaling_record(jam, bulk)}};
  return measurement;
}

}  // namespace isojam
