#include "engine/analysis/gaps.hpp"

#include "engine/analysis/contact_force.hpp"
#include "engine/analysis/pair_distribution.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Distributions of the gaps between near neighbours, of the contact forces and of the distances between centres. The
// bins are the same for all states.

constexpr QuantityGroup group{"gaps and forces",
                              "Number of pairs with a gap below Δφ·V_p^(1/3), and share of weak contact forces."};
constexpr std::string_view per_particle = "per particle";
constexpr Quantity within_distance{"gaps_within_distance", "/gaps/within_distance", group, per_particle,
                                   "Z_{h<\\Delta\\phi}"};
constexpr Quantity weak_forces{"weak_forces", "/gaps/weak_forces", group, "1", "P(f<\\langle f\\rangle/10)"};
constexpr std::array quantities{within_distance, weak_forces};

/// Ranges. Gaps are from 1e-8 to 0.1 V_p^(1/3), forces from 1e-6 to 10^1.6 in units of their mean.
constexpr int least_gap = -8 * Histogram::per_decade, gap_bins = 7 * Histogram::per_decade;
constexpr int least_force = -6 * Histogram::per_decade, force_bins = 38;
constexpr double widest = 0.1;
constexpr double weak = 0.1;

void put_gaps(Json& state, const Packing& packing, double distance) {
  Histogram faces(least_gap, gap_bins), crossed(least_gap, gap_bins);
  long near = 0;
  for (const Gap& gap : near_gaps(packing, widest)) {
    (gap.of_faces ? faces : crossed).add(gap.width);
    near += gap.width < distance;
  }
  put(state, within_distance,
      distance > 0 && distance <= widest ? std::optional(2 * static_cast<double>(near) / packing.size()) : std::nullopt,
      "Δφ is not between 0 and .1");
  Json& json = state["gaps"];
  json["log10_gap"] = faces.edges();
  json["faces"] = faces.record();
  json["edges"] = crossed.record();
}

void put_forces(Json& state, const Packing& packing, const ClassifiedContacts& classified) {
  const auto forces = contact_forces(packing, classified.contacts);
  double sum = 0;
  for (const auto& force : forces) sum += force.force_a.norm();
  const double mean = forces.empty() ? 0 : sum / static_cast<double>(forces.size());
  const bool classified_all = !undecided(classified.analysis) && mean > 0;
  long few = 0;
  std::vector<Histogram> by_class(3, Histogram(least_force, force_bins));
  for (std::size_t k = 0; k < forces.size() && mean > 0; ++k) {
    const double f = forces[k].force_a.norm() / mean;
    few += f < weak;
    by_class[classified_all ? static_cast<std::size_t>(classified.analysis.classes[k]) : 2].add(f);
  }
  put(state, weak_forces,
      mean > 0 ? std::optional(static_cast<double>(few) / static_cast<double>(forces.size())) : std::nullopt,
      "nothing touches");
  Json& json = state["gaps"];
  json["classes_told"] = classified_all;
  json["log10_force"] = by_class[0].edges();
  json["face_face"] = by_class[0].record();
  json["edge_face"] = by_class[1].record();
  json["lower_order"] = by_class[2].record();
}

/// Bins of g(r) (V_p^(1/3)).
constexpr double r_width = 0.1, farthest_r = 5;

void put_pair_distribution(Json& state, const Packing& packing) {
  const auto g = pair_distribution(packing, r_width, farthest_r);
  Json &r = state["gaps"]["r"] = Json::array(), &values = state["gaps"]["g"] = Json::array();
  for (std::size_t k = 0; k <= g.size(); ++k) r.push_back(to_digits(r_width * static_cast<double>(k), 4));
  for (const double value : g) values.push_back(to_digits(value, 6));
}

Measurement measure_gaps(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const double distance = jam.phi_j ? packing.density() - jam.phi_j->density : 0;
    Json state;
    put_gaps(state, packing, distance);
    put_forces(state, packing, classified_contacts(packing, energy));
    put_pair_distribution(state, packing);
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::gaps{.quantities = quantities, .measure = measure_gaps};

}  // namespace isojam
