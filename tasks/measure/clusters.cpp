#include "engine/analysis/cluster_statistics.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

constexpr QuantityGroup group{"clusters", "Clusters of particles that are connected by face-face contacts."};
constexpr Quantity mean_size{"S", "/clusters/S", group, "particles", "S"};
constexpr Quantity extent{"l_max", "/clusters/l_max", group, "L", "l_{max}/L"};
constexpr Quantity dimension_of_longest{"D_max", "/clusters/D", group, "1", "D_{max}"};
constexpr Quantity percolation = proportion({"percolates", "/clusters/percolates", group, "1", "P"});
constexpr std::array quantities{mean_size, extent, dimension_of_longest, percolation};

Json cluster_record(const Packing& packing, const ClassifiedContacts& classified) {
  Json state;
  Json& json = state["clusters"] = Json::object();
  if (const auto why = undecided(classified.analysis)) {
    for (const Quantity& quantity : {mean_size, percolation, extent, dimension_of_longest})
      put(state, quantity, std::nullopt, *why);
    return state;
  }
  const auto bonds = bonds_of(classified.contacts, classified.analysis.classes);
  const auto clusters = find_clusters(packing, bonds);
  const auto statistics = cluster_statistics(packing, bonds, clusters);
  put(state, mean_size, statistics.S);
  json["largest"] = statistics.largest;
  json["winding_rank"] = statistics.winding_rank;
  put(state, percolation, statistics.winding_rank > 0 ? 1 : 0);
  json["spans"] = statistics.spans ? 1 : 0;
  put(state, extent, statistics.l_max, "a cluster winds around the cell and has no end");
  put_optional(json, "body_l_max", statistics.body_l_max, "a cluster winds around the cell and has no end");
  const auto& dimension = statistics.D_max;
  const bool fitted = dimension.verdict == DimensionVerdict::fitted;
  put(state, dimension_of_longest, fitted ? std::optional(dimension.D) : std::nullopt, to_string(dimension.verdict));
  put_optional(json, "D_error", fitted ? std::optional(dimension.error) : std::nullopt, to_string(dimension.verdict));
  return state;
}

Measurement measure_clusters(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto classified = classified_contacts(jam.states[k], energy);
    auto state = cluster_record(jam.states[k], classified);
    if (k == nearest && !undecided(classified.analysis)) {
      const auto bonds = bonds_of(classified.contacts, classified.analysis.classes);
      state["clusters"]["labels"] = cluster_labels(find_clusters(jam.states[k], bonds), jam.states[k].size());
    }
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::clusters{
    .quantities = quantities, .measure = measure_clusters, .by_default = true, .at_zero_pressure = true};

}  // namespace isojam
