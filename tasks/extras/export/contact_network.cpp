#include "tasks/extras/export/contact_network.hpp"

namespace isojam {
namespace {

template <class Vector>
void append(std::vector<Json>& row, const Vector& v) {
  for (const auto component : v) row.emplace_back(component);
}

Json number_or_null(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

std::vector<Json> row_of(const std::string& replicate, const StoredState& state, const NetworkContact& contact) {
  const auto& [pair, alignment, contact_class, force, gap] = contact;
  const auto solid = [&](int particle) { return state.packing.solids.unit(static_cast<std::size_t>(particle)).name(); };
  std::vector<Json> row{replicate, state.index, number_or_null(state.delta_phi), pair.a, pair.b};
  append(row, pair.shift);
  row.insert(row.end(), {force.volume, force.area});
  for (const auto* v : {&force.force_a, &force.attack, &force.normal, &force.torque_a, &force.torque_b})
    append(row, *v);
  row.emplace_back(contact_class ? Json(to_string(*contact_class)) : Json(nullptr));
  row.insert(row.end(), {Json(to_string(force.kind)), alignment.edge_face, alignment.face_face, force.depth,
                         solid(pair.a), solid(pair.b)});
  return row;
}

}  // namespace

std::vector<NetworkContact> contact_network(const Packing& packing, const ClassifiedContacts& classified) {
  const auto forces = contact_forces(packing, classified.contacts);
  const bool decided = !undecided(classified.analysis);
  std::vector<NetworkContact> network;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    network.push_back({classified.contacts[k].pair, classified.alignments[k],
                       decided ? std::optional(classified.analysis.classes[k]) : std::nullopt, forces[k],
                       classified.gaps[k]});
  }
  return network;
}

const Columns& contact_columns() {
  static const Columns columns{"replicate",  "state",      "delta_phi",  "a",          "b",          "image_x",
                               "image_y",    "image_z",    "volume",     "area",       "force_x",    "force_y",
                               "force_z",    "attack_x",   "attack_y",   "attack_z",   "normal_x",   "normal_y",
                               "normal_z",   "torque_a_x", "torque_a_y", "torque_a_z", "torque_b_x", "torque_b_y",
                               "torque_b_z", "class",      "kind",       "theta_ef",   "theta_ff",   "depth",
                               "solid_a",    "solid_b",    "x",          "gap"};
  return columns;
}

const Columns& contact_texts() {
  static const Columns texts{"replicate", "class", "kind", "solid_a", "solid_b"};
  return texts;
}

std::string contact_lines(RowFormat format, const std::string& replicate, const StoredState& state) {
  std::string text;
  PackingEnergy energy;
  const auto network = contact_network(state.packing, classified_contacts(state.packing, energy, state.gap));
  for (std::size_t k = 0; k < network.size(); ++k) {
    auto row = row_of(replicate, state, network[k]);
    row.push_back(number_or_null(k < state.exponents.size() ? state.exponents[k] : std::nullopt));
    row.emplace_back(network[k].gap);
    text += row_line(format, contact_columns(), row);
  }
  return text;
}

}  // namespace isojam
