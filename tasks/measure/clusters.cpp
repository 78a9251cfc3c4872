#include "engine/analysis/cluster_statistics.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

/// What is optional is absent if the contacts are not classified.
struct Clusters {
  Reasoned<> S;
  std::optional<int> largest, winding_rank;
  Reasoned<int> percolates;
  std::optional<int> spans;
  Reasoned<> l_max;
  std::optional<Reasoned<>> body_l_max;
  Reasoned<> D;
  std::optional<Reasoned<>> D_error;
  std::optional<std::vector<int>> labels;
};
void describe(Fields& field, Clusters& clusters) {
  constexpr QuantityGroup group{"clusters", "Clusters of particles that are connected by face-face contacts."};
  field("S", clusters.S,
        "Mean cluster size Σs²/Σs, where s is the number of particles of a cluster and the sums are over all clusters. "
        "It is the mean, over all particles, of the size of the cluster to which the particle belongs.")
      .unit("particles")
      .column({"S", group, "S"});
  field("largest", clusters.largest, "Number of particles in the largest cluster.");
  field("winding_rank", clusters.winding_rank,
        "Largest number of independent directions, from 0 to 3, in which a cluster is connected to its own periodic "
        "images.");
  field("percolates", clusters.percolates, "1 if a cluster is connected to its own periodic image, 0 if not.")
      .range({0, 1})
      .column({.name = "percolates", .group = group, .latex = "P", .place = 1, .proportion = true});
  field("spans", clusters.spans,
        "1 if the extent of a cluster is at least L, or if a cluster is connected to its own periodic image; 0 if not.")
      .range({0, 1});
  field("l_max", clusters.l_max,
        "Largest extent of a cluster along the x, y or z axis, measured between particle centres and divided by L; "
        "null if a cluster is connected to its own periodic image.")
      .unit("L")
      .column({"l_max", group, "l_{max}/L"});
  field("body_l_max", clusters.body_l_max,
        "Largest extent of a cluster along the x, y or z axis, measured between vertices and divided by L; null if a "
        "cluster is connected to its own periodic image.");
  field("D", clusters.D, "Fractal dimension of the cluster with the largest extent.")
      .column({"D_max", group, "D_{max}"});
  field("D_error", clusters.D_error, "Standard error of the fit of D.");
  field("labels", clusters.labels,
        "For every particle, the label of its cluster: the smallest index among the particles of the cluster. Only the "
        "state nearest jamming has this field.")
      .detail();
}

struct State {
  Clusters clusters;
};
void describe(Fields& field, State& state) {
  field("clusters", state.clusters,
        "Clusters: sets of particles that face-face contacts connect. If the fit of θ_ff or of θ_ef found no cut-off, "
        "the fields `S`, `percolates`, `l_max` and `D` are null, and the other fields are absent.");
}

Clusters clusters_of(const Packing& packing, const ClassifiedContacts& classified, bool with_labels) {
  Clusters record;
  if (const auto why = undecided(classified.analysis)) {
    for (auto* value : {&record.S, &record.l_max, &record.D}) value->reason = *why;
    record.percolates.reason = *why;
    return record;
  }
  const auto bonds = bonds_of(classified.contacts, classified.analysis.classes);
  const auto clusters = find_clusters(packing, bonds);
  const auto statistics = cluster_statistics(packing, bonds, clusters);
  constexpr std::string_view winds = "a cluster winds around the cell and has no end";
  record.S.value = statistics.S;
  record.largest = statistics.largest;
  record.winding_rank = statistics.winding_rank;
  record.percolates.value = statistics.winding_rank > 0;
  record.spans = statistics.spans;
  record.l_max = reasoned(statistics.l_max, winds);
  record.body_l_max = reasoned(statistics.body_l_max, winds);
  const auto& [verdict, D, error, points] = statistics.D_max;
  const bool fitted = verdict == DimensionVerdict::fitted;
  record.D = given(fitted, D, to_string(verdict));
  record.D_error = given(fitted, error, to_string(verdict));
  if (with_labels) record.labels = cluster_labels(clusters, packing.size());
  return record;
}

Measurement measure_clusters(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto classified = classified_contacts(jam.states[k], energy, options.gap);
    measurement.states.push_back(written(State{clusters_of(jam.states[k], classified, k == nearest)}));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::clusters{.state = part_of<State>(),
                                           .measure = measure_clusters,
                                           .by_default = true,
                                           .at_zero_pressure = true,
                                           .as_given = true};

}  // namespace isojam
