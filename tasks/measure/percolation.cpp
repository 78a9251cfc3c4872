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

constexpr QuantityGroup group{
    "percolation",
    "Clusters of face-face contacts with fitted cut-offs, gaps and troughs, and of as many contacts drawn at random."};

/// Quantities of the clusters by one method.
struct Method {
  std::string_view name;
  Quantity S, largest, winding, S_random, largest_random, winds_random;
};
constexpr std::array methods{
    Method{"fit",
           {"S_fit", "/percolation/fit/S", group, "particles", "S^{fit}"},
           {"largest_fit", "/percolation/fit/largest", group, "1", "P_1^{fit}"},
           {"winding_fit", "/percolation/fit/winding_rank", group, "1", "d_w^{fit}"},
           {"S_fit_random", "/percolation/fit/random/S", group, "particles", "S^{fit}_r"},
           {"largest_fit_random", "/percolation/fit/random/largest", group, "1", "P^{fit}_{1,r}"},
           {"winds_fit_random", "/percolation/fit/random/winds", group, "1", "P^{fit}_{w,r}"}},
    Method{"gap",
           {"S_gap", "/percolation/gap/S", group, "particles", "S^{gap}"},
           {"largest_gap", "/percolation/gap/largest", group, "1", "P_1^{gap}"},
           {"winding_gap", "/percolation/gap/winding_rank", group, "1", "d_w^{gap}"},
           {"S_gap_random", "/percolation/gap/random/S", group, "particles", "S^{gap}_r"},
           {"largest_gap_random", "/percolation/gap/random/largest", group, "1", "P^{gap}_{1,r}"},
           {"winds_gap_random", "/percolation/gap/random/winds", group, "1", "P^{gap}_{w,r}"}},
    Method{"trough",
           {"S_trough", "/percolation/trough/S", group, "particles", "S^{trough}"},
           {"largest_trough", "/percolation/trough/largest", group, "1", "P_1^{trough}"},
           {"winding_trough", "/percolation/trough/winding_rank", group, "1", "d_w^{trough}"},
           {"S_trough_random", "/percolation/trough/random/S", group, "particles", "S^{trough}_r"},
           {"largest_trough_random", "/percolation/trough/random/largest", group, "1", "P^{trough}_{1,r}"},
           {"winds_trough_random", "/percolation/trough/random/winds", group, "1", "P^{trough}_{w,r}"}}};
constexpr std::size_t per_method = 6;
constexpr auto quantities = [] {
  std::array<Quantity, methods.size() * per_method> list{};
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const Method& method = methods[m];
    const std::array of{method.S,        method.largest,        method.winding,
                        method.S_random, method.largest_random, method.winds_random};
    for (std::size_t k = 0; k < per_method; ++k) list[per_method * m + k] = of[k];
  }
  return list;
}();

/// Draws of random bonds for each state and method. With so many, the standard error of a share is at most 0.035.
constexpr int draws = 200;

/// The face-face contacts of a packing, or the reason why they are unknown.
struct FaceFace {
  std::vector<NeighbourPair> bonds;
  std::string_view why;
};

FaceFace by_fit(const Packing&, const ClassifiedContacts& classified) {
  if (!classified.analysis.face_face.has_cutoff()) return {{}, "no face-face cut-off"};
  return {bonds_of(classified.contacts, classified.analysis.classes), ""};
}

/// The contacts with θ_ff below a cut-off, which may depend on the contact.
template <class Cutoff>
FaceFace below(const ClassifiedContacts& classified, const Cutoff& cutoff) {
  FaceFace found;
  for (std::size_t k = 0; k < classified.contacts.size(); ++k) {
    const Contact& contact = classified.contacts[k];
    if (classified.alignments[k].face_face < cutoff(contact)) found.bonds.push_back(contact.pair);
  }
  return found;
}

FaceFace by_gap(const Packing& packing, const ClassifiedContacts& classified) {
  if (!classified.analysis.Z_ff_gap) return {{}, to_string(classified.analysis.face_face_gap.verdict)};
  return below(classified, [&](const Contact& contact) {
    const auto& a = packing.solids.unit(static_cast<std::size_t>(contact.pair.a));
    const auto& b = packing.solids.unit(static_cast<std::size_t>(contact.pair.b));
    return classified.analysis.cutoffs_of(a, b).face_face_gap.cutoff;
  });
}

FaceFace by_trough(const Packing&, const ClassifiedContacts& classified) {
  const TroughCutoffs troughs = trough_cutoffs(histogram_of(classified));
  if (!troughs.has_face_face()) return {{}, "no trough in θ_ff"};
  return below(classified, [&](const Contact&) { return angle_bin_edge(troughs.face_face.cutoff); });
}

void put_method(Json& state, const Method& method, const Packing& packing, const ClassifiedContacts& classified,
                const FaceFace& face_face) {
  if (!face_face.why.empty()) {
    for (const Quantity& quantity :
         {method.S, method.largest, method.winding, method.S_random, method.largest_random, method.winds_random})
      put(state, quantity, std::nullopt, face_face.why);
    return;
  }
  std::vector<NeighbourPair> all;
  for (const Contact& contact : classified.contacts) all.push_back(contact.pair);
  const auto& bonds = face_face.bonds;
  const Percolation found = percolation(packing, bonds);
  put(state, method.S, found.S);
  put(state, method.largest, found.largest);
  put(state, method.winding, found.winding_rank);
  Json& json = place_of(state, method.S).object;
  json["bonds"] = bonds.size();
  json["sizes"] = Json::array();
  for (const auto& [size, clusters] : found.sizes) json["sizes"].push_back({size, clusters});
  RandomStream random{static_cast<std::uint64_t>(Purpose::percolation), static_cast<std::uint64_t>(packing.size()),
                      all.size(), bonds.size()};
  const RandomPercolation null = random_percolation(packing, all, bonds.size(), draws, random);
  put(state, method.S_random, null.S);
  put(state, method.largest_random, null.largest);
  put(state, method.winds_random, null.winds[0]);
  json["random"]["draws"] = draws;
  json["random"]["winds_in_two"] = null.winds[1];
  json["random"]["winds_in_three"] = null.winds[2];
}

Measurement measure_percolation(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  constexpr std::array<FaceFace (*)(const Packing&, const ClassifiedContacts&), methods.size()> find{by_fit, by_gap,
                                                                                                     by_trough};
  for (const Packing& packing : jam.states) {
    const auto classified = classified_contacts(packing, energy);
    Json state;
    for (std::size_t m = 0; m < methods.size(); ++m)
      put_method(state, methods[m], packing, classified, find[m](packing, classified));
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::percolation{
    .quantities = quantities, .measure = measure_percolation, .at_zero_pressure = true};

}  // namespace isojam
