#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/order.hpp"
#include "engine/analysis/power_law.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {

ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy) {
  ClassifiedContacts classified;
  classified.contacts = energy.contacts(packing);
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
  const double bin = value > 0 ? std::floor(nearest::log10(value) * per_decade) - least_ : -1;
  if (bin < 0) {
    ++below_;
  } else {
    ++counts_[std::min(static_cast<std::size_t>(bin), counts_.size() - 1)];
  }
}

Json Histogram::record() const {
  Json json;
  json["below"] = below_;
  json["counts"] = counts_;
  return json;
}

Json Histogram::edges() const {
  Json list = Json::array();
  for (std::size_t k = 0; k <= counts_.size(); ++k)
    list.push_back(static_cast<double>(least_ + static_cast<int>(k)) / per_decade);
  return list;
}

double to_digits(double x, int digits) { return parsed(fmt::format("{:.{}e}", x, digits - 1)).get<double>(); }

std::optional<std::string_view> not_jammed(const Packing& packing, PackingEnergy& energy) {
  constexpr double balanced = 1e-3;
  const auto here = energy.evaluate(packing, Precision::double_double);
  if (!(here.pressure > 0)) return "the packing bears no pressure";
  if (!(here.residual <= balanced)) return "forces do not balance";
  return std::nullopt;
}

void put_scaling(Json& replicate, const Quantity& exponent, const JamResult& jam,
                 const std::vector<std::optional<double>>& y) {
  std::vector<double> distances, values;
  for (std::size_t k = 0; k < jam.states.size() && jam.phi_j; ++k) {
    const double distance = jam.states[k].density() - jam.phi_j->density;
    if (!y[k] || distance <= 0 || distance > scaling_window) continue;
    distances.push_back(distance);
    values.push_back(*y[k]);
  }
  const auto law = fit_power_law(distances, values);
  const bool has_interval = law && law->points > 2;
  put(replicate, exponent, law ? std::optional(law->exponent) : std::nullopt, "fewer than two states");
  Json& json = place_of(replicate, exponent).object;
  put_optional(json, "ci95_half_width", has_interval ? std::optional(law->ci95_half_width) : std::nullopt,
               "fewer than three states");
  json["points"] = law ? law->points : 0;
}

}  // namespace isojam
