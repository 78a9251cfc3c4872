#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/analysis/gaps.hpp"
#include "engine/analysis/order.hpp"
#include "engine/analysis/power_law.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {

StateContacts contacts_of(const Packing& packing, PackingEnergy& energy, double gap) {
  StateContacts all{energy.contacts(packing), {}};
  std::map<decltype(canonical_key(NeighbourPair())), double> width;
  if (gap > 0) {
    for (const Gap& near : near_gaps(packing, gap)) {
      all.contacts.push_back(as_contact(packing, near, gap));
      width[canonical_key(near.pair)] = near.width;
    }
    std::sort(all.contacts.begin(), all.contacts.end(),
              [](const Contact& a, const Contact& b) { return canonical_key(a.pair) < canonical_key(b.pair); });
  }
  for (const Contact& contact : all.contacts) {
    const auto found = width.find(canonical_key(contact.pair));
    all.gaps.push_back(found == width.end() ? 0 : found->second);
  }
  return all;
}

ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy, double gap) {
  ClassifiedContacts classified{contacts_of(packing, energy, gap), {}, {}};
  classified.alignments = alignments(packing.solids, classified.contacts);
  classified.analysis = analyse_contacts(packing.solids, packing.size(), classified.contacts, classified.alignments);
  classified.analysis.Q6 = contact_q6(classified.contacts);
  return classified;
}

std::optional<std::string_view> undecided(const ContactAnalysis& analysis) {
  if (!analysis.face_face.has_cutoff()) return "no face-face cut-off";
  if (!analysis.edge_face.has_cutoff()) return "no edge-face cut-off";
  return std::nullopt;
}

void Histogram::add(double value) {
  const double bin = value > 0 ? std::floor(nearest::log10(value) * per_decade) - least : -1;
  if (bin < 0) {
    ++below;
  } else {
    ++counts[std::min(static_cast<std::size_t>(bin), counts.size() - 1)];
  }
}

std::vector<double> Histogram::edges() const {
  std::vector<double> list;
  for (std::size_t k = 0; k <= counts.size(); ++k)
    list.push_back(static_cast<double>(least + static_cast<int>(k)) / per_decade);
  return list;
}

void describe(Fields& field, Histogram& bins) {
  field.type("bins", "Histogram of gaps, of forces or of angles.");
  field("below", bins.below, "Number of values below the first bin.");
  field("counts", bins.counts, "Number of values in each bin. The last bin also contains larger values.");
}

double to_digits(double x, int digits) { return parsed(fmt::format("{:.{}e}", x, digits - 1)).get<double>(); }

std::optional<std::string_view> not_jammed(const Packing& packing, PackingEnergy& energy) {
  constexpr double balanced = 1e-3;
  const auto here = energy.evaluate(packing, Precision::double_double);
  if (!(here.pressure > 0)) return "the packing bears no pressure";
  if (!(here.residual <= balanced)) return "forces do not balance";
  return std::nullopt;
}

Scaling scaling_of(const JamResult& jam, const std::vector<std::optional<double>>& y) {
  std::vector<double> distances, values;
  for (std::size_t k = 0; k < jam.states.size() && jam.phi_j; ++k) {
    const double distance = jam.states[k].density() - jam.phi_j->density;
    if (!y[k] || distance <= 0 || distance > scaling_window) continue;
    distances.push_back(distance);
    values.push_back(*y[k]);
  }
  const auto law = fit_power_law(distances, values);
  if (!law) return {{{}, "fewer than two states"}, {{}, "fewer than three states"}};
  return {{law->exponent, ""}, given(law->points > 2, law->ci95_half_width, "fewer than three states"), law->points};
}

void add_scaling(Fields& field, const std::string& key, Scaling& law, const std::string& name, std::string_view latex,
                 std::string_view symbol, const Words& meaning) {
  const Column exponent{"x_" + name,
                        {"exponents", "Exponents of power laws in the distance to jamming Δφ."},
                        fmt::format("x_{}", latex),
                        fmt::format("Exponent x of {} ∝ Δφ^x, fitted to the states with Δφ ≤ 0.02.", symbol)};
  const auto describe_law = [&law, exponent](Fields& inner) {
    inner.type("scaling", "Power law y ∝ Δφ^x, fitted to the states with Δφ ≤ 0.02.");
    inner("exponent", law.exponent,
          "Exponent x: the slope of ln y as a function of ln Δφ in a least-squares fit; null with fewer than two "
          "states.")
        .column(exponent);
    inner("ci95_half_width", law.ci95_half_width,
          "Half width of the 95 % confidence interval of x in the fit (Student t); null with fewer than three states.");
    inner("points", law.points, "Number of fitted states.");
  };
  field.nested(key, describe_law, meaning);
}

}  // namespace isojam
