#include "engine/analysis/gaps.hpp"

#include <algorithm>
#include <cmath>

#include "engine/analysis/contact_force.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Distributions of the gaps between near neighbours and of the contact forces. The logarithmic bins are the same for
// all states.

constexpr std::string_view group = "gaps and forces", per_particle = "per particle";
constexpr Quantity within_distance{"gaps_within_distance", "/gaps/within_distance", group, per_particle,
                                   "Z_{h<\\Delta\\phi}"};
constexpr Quantity weak_forces{"weak_forces", "/gaps/weak_forces", group, "1", "P(f<\\langle f\\rangle/10)"};
constexpr std::array quantities{within_distance, weak_forces};

/// Bins per decade, and ranges. Gaps are from 1e-8 to 0.1 V_p^(1/3), forces from 1e-6 to 10^1.6 in units of their mean.
constexpr int bins_per_decade = 5;
constexpr int least_gap = -8 * bins_per_decade, gap_bins = 7 * bins_per_decade;
constexpr int least_force = -6 * bins_per_decade, force_bins = 38;
constexpr double widest = 0.1;
constexpr double weak = 0.1;

/// Numbers of values in logarithmic bins, and number of values below the first bin.
class Histogram {
 public:
  Histogram(int least, int bins) : least_(least), counts_(static_cast<std::size_t>(bins), 0) {}
  void add(double value) {
    const auto bin = static_cast<long>(std::floor(nearest::log10(value) * bins_per_decade)) - least_;
    if (bin < 0) {
      ++below_;
    } else {
      ++counts_[static_cast<std::size_t>(std::min<long>(bin, static_cast<long>(counts_.size()) - 1))];
    }
  }
  Json record() const {
    Json json;
    json["below"] = below_;
    json["counts"] = counts_;
    return json;
  }

 private:
  int least_;
  long below_ = 0;
  std::vector<long> counts_;
};

/// Base-10 logarithms of the lower edges of all bins and of the upper edge of the last bin.
Json edges(int least, int bins) {
  Json list = Json::array();
  for (int k = 0; k <= bins; ++k) list.push_back(static_cast<double>(least + k) / bins_per_decade);
  return list;
}

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
  json["log10_gap"] = edges(least_gap, gap_bins);
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
  json["log10_force"] = edges(least_force, force_bins);
  json["face_face"] = by_class[0].record();
  json["edge_face"] = by_class[1].record();
  json["lower_order"] = by_class[2].record();
}

Measurement measure_gaps(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const double distance = jam.phi_j ? packing.density() - jam.phi_j->density : 0;
    Json state;
    put_gaps(state, packing, distance);
    put_forces(state, packing, classified_contacts(packing, energy));
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::gaps{.quantities = quantities, .measure = measure_gaps};

}  // namespace isojam
