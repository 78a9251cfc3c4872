#include "engine/vibration/backbone.hpp"

#include <numeric>
#include <utility>

#include "engine/vibration/dynamical_matrix.hpp"

namespace isojam {

namespace {

void assess_rest(Backbone& rest, const ModeOptions& options, Precision precision) {
  PackingEnergy energy;
  rest.here = energy.evaluate(rest.packing, precision);
  rest.hessian = energy.hessian(rest.packing, precision);
  const BlockMatrix matrix = dynamical_matrix(rest.packing, rest.hessian);
  const double torque = unbalanced_torque(rest.here, rest.packing.solids) * greatest_inverse_mass(rest.packing);
  rest.ends = spectrum_ends(matrix, options);
  rest.stability = assess(matrix, rest.ends, torque);
}

/// Indices of the particles of the whole packing that are not in `kept`.
std::vector<int> others(std::span<const int> kept, int particles) {
  std::vector<int> result;
  auto next = kept.begin();
  for (int i = 0; i < particles; ++i) {
    if (next != kept.end() && *next == i) {
      ++next;
    } else {
      result.push_back(i);
    }
  }
  return result;
}

}  // namespace

Packing part_of(const Packing& packing, std::span<const int> kept) {
  Packing part{packing.solids, packing.cell, {}};
  for (const int i : kept) part.poses.push_back(packing.poses[static_cast<std::size_t>(i)]);
  if (packing.solids.is_uniform() || kept.empty()) return part;
  std::vector<Particle> particles;
  for (const int i : kept) particles.push_back(packing.solids.particles()[static_cast<std::size_t>(i)]);
  part.solids = Composition(particles);
  return part;
}

PartContacts contacts_within(std::span<const Contact> contacts, std::span<const int> kept, int particles) {
  std::vector<int> number(static_cast<std::size_t>(particles), -1);
  for (std::size_t k = 0; k < kept.size(); ++k) number[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
  PartContacts part;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const int a = number[static_cast<std::size_t>(contacts[k].pair.a)];
    const int b = number[static_cast<std::size_t>(contacts[k].pair.b)];
    if (a < 0 || b < 0) continue;
    part.contacts.push_back(contacts[k]);
    part.contacts.back().pair.a = a;
    part.contacts.back().pair.b = b;
    part.places.push_back(k);
  }
  return part;
}

Backbone backbone_of(const Packing& packing, const ModeOptions& options, Precision precision) {
  Backbone rest{.packing = packing, .kept = std::vector<int>(static_cast<std::size_t>(packing.size()))};
  std::iota(rest.kept.begin(), rest.kept.end(), 0);
  while (!rest.kept.empty()) {
    assess_rest(rest, options, precision);
    const auto& named = rest.stability.near_rattlers;
    if (named.empty()) break;
    std::vector<char> goes(rest.kept.size(), 0);
    for (const NearRattler& rattler : named) goes[static_cast<std::size_t>(rattler.particle)] = 1;
    std::vector<int> kept;
    for (std::size_t k = 0; k < rest.kept.size(); ++k) {
      if (!goes[k]) kept.push_back(rest.kept[k]);
    }
    Packing part = part_of(packing, kept);
    rest = {.packing = std::move(part), .kept = std::move(kept), .rounds = rest.rounds + 1};
  }
  rest.removed = others(rest.kept, packing.size());
  return rest;
}

std::optional<ElasticTensor> elastic_tensor(const Backbone& backbone) {
  if (backbone.kept.empty()) return std::nullopt;
  const std::vector<Contact> contacts = PackingEnergy().contacts(backbone.packing);
  return elastic_tensor(backbone.packing, backbone.hessian, contacts, backbone.here);
}

}  // namespace isojam
