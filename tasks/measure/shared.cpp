#include "engine/analysis/order.hpp"
#include "engine/analysis/power_law.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {

ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy) {
  ClassifiedContacts classified;
  classified.contacts = energy.contacts(packing);
  classified.alignments = alignments(*packing.solid, classified.contacts);
  classified.analysis = analyse_contacts(*packing.solid, packing.size(), classified.alignments);
  classified.analysis.Q6 = contact_q6(classified.contacts);
  return classified;
}

void put_optional(Json& json, const std::string& key, const std::optional<double>& value, std::string_view reason) {
  if (value) {
    put_number(json, key, *value);
  } else {
    put_absent(json, key, reason);
  }
}

Json scaling_record(const JamResult& jam, const std::vector<std::optional<double>>& y) {
  std::vector<double> distances, values;
  for (std::size_t k = 0; k < jam.states.size() && jam.phi_j; ++k) {
    const double distance = jam.states[k].density() - jam.phi_j->density;
    if (!y[k] || distance <= 0 || distance > scaling_window) continue;
    distances.push_back(distance);
    values.push_back(*y[k]);
  }
  const auto law = fit_power_law(distances, values);
  const bool has_interval = law && law->points > 2;
  Json json;
  put_optional(json, "exponent", law ? std::optional(law->exponent) : std::nullopt, "fewer than two states");
  put_optional(json, "ci95_half_width", has_interval ? std::optional(law->ci95_half_width) : std::nullopt,
               "fewer than three states");
  json["points"] = law ? law->points : 0;
  return json;
}

}  // namespace isojam
