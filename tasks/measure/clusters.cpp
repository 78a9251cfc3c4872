#include "engine/analysis/cluster_statistics.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

Json cluster_record(const Packing& packing, const ClassifiedContacts& classified) {
  Json json;
  if (const auto why = undecided(classified.analysis)) {
    for (const auto* key : {"S", "percolates", "l_max", "D"}) put_absent(json, key, *why);
    return json;
  }
  const auto bonds = bonds_of(classified.contacts, classified.analysis.classes);
  const auto clusters = find_clusters(packing, bonds);
  const auto statistics = cluster_statistics(packing, bonds, clusters);
  put_number(json, "S", statistics.S);
  json["largest"] = statistics.largest;
  json["winding_rank"] = statistics.winding_rank;
  json["percolates"] = statistics.winding_rank > 0 ? 1 : 0;
  json["spans"] = statistics.spans ? 1 : 0;
  put_optional(json, "l_max", statistics.l_max, "a cluster winds around the cell and has no end");
  put_optional(json, "body_l_max", statistics.body_l_max, "a cluster winds around the cell and has no end");
  const auto& dimension = statistics.D_max;
  const bool fitted = dimension.verdict == DimensionVerdict::fitted;
  put_optional(json, "D", fitted ? std::optional(dimension.D) : std::nullopt, to_string(dimension.verdict));
  put_optional(json, "D_error", fitted ? std::optional(dimension.error) : std::nullopt, to_string(dimension.verdict));
  return json;
}

}  // namespace

Measurement measure_clusters(const JamResult& jam) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto classified = classified_contacts(jam.states[k], energy);
    auto json = cluster_record(jam.states[k], classified);
    if (k == nearest && !undecided(classified.analysis)) {
      const auto bonds = bonds_of(classified.contacts, classified.analysis.classes);
      json["labels"] = cluster_labels(find_clusters(jam.states[k], bonds), jam.states[k].size());
    }
    measurement.states.push_back({{"clusters", std::move(json)}});
  }
  return measurement;
}

}  // namespace isojam
