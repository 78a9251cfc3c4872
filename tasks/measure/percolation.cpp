#include "engine/analysis/percolation.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tasks/measure/shared_parts.hpp"
#include "tasks/measure/trough_parts.hpp"

namespace isojam {
namespace {

// Clusters of face-face contacts, for the three methods that find the cut-off, and the null hypothesis of random bonds.

struct RandomBonds {
  Reasoned<> S, largest, winds;
  std::optional<int> draws;
  std::optional<double> winds_in_two, winds_in_three;
};
struct ClustersByMethod {
  Reasoned<> S, largest;
  Reasoned<int> winding_rank;
  std::optional<std::size_t> bonds;
  std::optional<std::vector<std::array<int, 2>>> sizes;
  RandomBonds random;
};
struct Percolations {
  ClustersByMethod fit, trough;
};

constexpr QuantityGroup group{
    "percolation",
    "Clusters of face-face contacts with fitted cut-offs and troughs, and of as many contacts drawn at random."};

/// Name of a method, and the cut-off by which it finds face-face contacts.
struct Method {
  std::string name, cutoff;

  Column column(const std::string& quantity, const std::string& latex, const std::string& meaning) const {
    return {quantity, group, latex, meaning};
  }
};

void describe_random(Fields& field, RandomBonds& random, const Method& method) {
  const std::string drawn = ", for as many random bonds.", latex = "^{" + method.name + "}";
  field("S", random.S, "Mean cluster size Σs²/Σs.")
      .unit("particles")
      .column(
          method.column("S_" + method.name + "_random", "S" + latex + "_r", "Like `S_" + method.name + "`" + drawn));
  field("largest", random.largest, "Number of particles in the largest cluster, divided by N.")
      .column(method.column("largest_" + method.name + "_random", "P^{" + method.name + "}_{1,r}",
                            "Like `largest_" + method.name + "`" + drawn));
  field("winds", random.winds,
        "Share of the draws in which a cluster is connected to its own periodic images in at least one direction.")
      .range({0, 1})
      .column(method.column("winds_" + method.name + "_random", "P^{" + method.name + "}_{w,r}",
                            "Probability that a cluster of as many random bonds is connected to its own periodic "
                            "image, with the " +
                                method.cutoff + "."));
  field("draws", random.draws, "Number of draws.").range({1, count_range.high});
  field("winds_in_two", random.winds_in_two, "Share of the draws with at least two such directions.")
      .range({0, 1})
      .finite();
  field("winds_in_three", random.winds_in_three, "Share of the draws with three such directions.")
      .range({0, 1})
      .finite();
}

void describe_method(Fields& field, ClustersByMethod& found, const Method& method) {
  field.type("percolation",
             "Clusters of the face-face contacts by one method. If the method finds no cut-off, all values are null, "
             "and `bonds`, `sizes` and `draws` are absent.");
  const std::string with = ", with the " + method.cutoff + ".", latex = "^{" + method.name + "}";
  field("S", found.S,
        "Mean cluster size Σs²/Σs, where s is the number of particles of a cluster and the sums are over all clusters. "
        "A particle without face-face contacts is a cluster too.")
      .unit("particles")
      .column(method.column("S_" + method.name, "S" + latex, "Mean size of the clusters of face-face contacts" + with));
  field("largest", found.largest, "Number of particles in the largest cluster, divided by N.")
      .column(method.column("largest_" + method.name, "P_1" + latex,
                            "Share of the particles that are in the largest cluster of face-face contacts" + with));
  field("winding_rank", found.winding_rank,
        "Largest number of independent directions, from 0 to 3, in which a cluster is connected to its own periodic "
        "images.")
      .range({0, 3})
      .column(method.column("winding_" + method.name, "d_w" + latex,
                            "Number of independent directions in which a cluster of face-face contacts is connected "
                            "to its own periodic images" +
                                with));
  field("bonds", found.bonds, "Number of face-face contacts.");
  field("sizes", found.sizes,
        "Numbers of clusters: for each size s that occurs, s and the number n_s of clusters with s particles.")
      .range({1, count_range.high})
      .detail();
  field.nested(
      "random", [&found, method](Fields& inner) { describe_random(inner, found.random, method); },
      "Means over draws of random bonds: as many contacts as there are face-face contacts, drawn from all "
      "contacts of the state.");
}

void describe(Fields& field, Percolations& all) {
  const auto add = [&](ClustersByMethod& found, const Method& method) {
    field.nested(
        method.name, [&found, method](Fields& inner) { describe_method(inner, found, method); },
        "Clusters with the " + method.cutoff + ".");
  };
  add(all.fit, {"fit", "fitted cut-off"});
  add(all.trough, {"trough", "cut-off in the trough of the density of log10 θ_ff"});
}

struct State {
  Percolations percolation;
};
void describe(Fields& field, State& state) {
  field("percolation", state.percolation,
        "Clusters that face-face contacts form, for two methods that find the cut-off of θ_ff, and clusters of "
        "random bonds.");
}

/// Draws of random bonds for each state and method. With so many, the standard error of a share is at most 0.035.
constexpr int draws = 200;

/// The face-face contacts of a packing, or the reason why they are unknown.
struct FaceFace {
  std::vector<NeighbourPair> bonds;
  std::string_view why;
};

FaceFace by_fit(const ClassifiedContacts& classified) {
  if (!classified.analysis.face_face.has_cutoff()) return {{}, "no face-face cut-off"};
  return {bonds_of(classified.contacts, classified.analysis.classes), ""};
}

FaceFace by_trough(const ClassifiedContacts& classified) {
  const TroughCutoffs troughs = trough_cutoffs(histogram_of(classified));
  if (!troughs.has_face_face()) return {{}, "no trough in θ_ff"};
  FaceFace found;
  for (std::size_t k = 0; k < classified.contacts.size(); ++k) {
    if (classified.alignments[k].face_face < angle_bin_edge(troughs.face_face.cutoff))
      found.bonds.push_back(classified.contacts[k].pair);
  }
  return found;
}

ClustersByMethod clusters_of(const Packing& packing, const ClassifiedContacts& classified, const FaceFace& face_face) {
  ClustersByMethod record;
  if (!face_face.why.empty()) {
    auto& random = record.random;
    for (auto* value : {&record.S, &record.largest, &random.S, &random.largest, &random.winds})
      value->reason = face_face.why;
    record.winding_rank.reason = face_face.why;
    return record;
  }
  std::vector<NeighbourPair> all;
  for (const Contact& contact : classified.contacts) all.push_back(contact.pair);
  const auto& bonds = face_face.bonds;
  const Percolation found = percolation(packing, bonds);
  RandomStream random{static_cast<std::uint64_t>(Purpose::percolation), static_cast<std::uint64_t>(packing.size()),
                      all.size(), bonds.size()};
  const RandomPercolation null = random_percolation(packing, all, bonds.size(), draws, random);
  record.S.value = found.S;
  record.largest.value = found.largest;
  record.winding_rank.value = found.winding_rank;
  record.bonds = bonds.size();
  record.sizes.emplace();
  for (const auto& [size, clusters] : found.sizes) record.sizes->push_back({size, clusters});
  record.random = {{null.S, ""}, {null.largest, ""}, {null.winds[0], ""}, draws, null.winds[1], null.winds[2]};
  return record;
}

Measurement measure_percolation(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const auto classified = classified_contacts(packing, energy, options.gap);
    const auto found = [&](const FaceFace& face_face) { return clusters_of(packing, classified, face_face); };
    measurement.states.push_back(written(State{{found(by_fit(classified)), found(by_trough(classified))}}));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::percolation{
    .state = part_of<State>(), .measure = measure_percolation, .at_zero_pressure = true, .as_given = true};

}  // namespace isojam
