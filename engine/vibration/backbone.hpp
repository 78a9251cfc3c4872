#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/vibration/moduli.hpp"
#include "engine/vibration/spectrum.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

/// A packing without its near-rattlers. They are removed recursively: those that assess() reports in the packing, then
/// those that it reports in the rest, until it reports none. The remaining particles keep their poses and the cell,
/// without a new minimisation. `here` contains their force residual, which is as before if the removed particles
/// carried no force.
struct Backbone {
  Packing packing;  ///< the remaining particles in their order; without any, it has no poses, and the rest is empty
  std::vector<int> kept{};     ///< their indices in the whole packing, ascending
  std::vector<int> removed{};  ///< indices of the removed particles, ascending
  int rounds = 0;              ///< number of rounds that removed particles
  Evaluation here{};           ///< evaluation of the remaining packing; the members below refer to it too
  BlockMatrix hessian{};       ///< its Hessian
  SpectrumEnds ends{};         ///< its modes
  Stability stability{};       ///< counts of its modes; no near-rattler is left
};

/// Removes near-rattlers until none is reported.
Backbone backbone_of(const Packing& packing, const ModeOptions& options = {},
                     Precision precision = Precision::double_double);

/// A part of a packing in the same cell; `kept` contains ascending indices of particles.
Packing part_of(const Packing& packing, std::span<const int> kept);

/// The contacts between the particles of a part.
struct PartContacts {
  std::vector<Contact> contacts;    ///< contacts with the particle numbers of the part
  std::vector<std::size_t> places;  ///< index of each contact in the full list
};
/// Contacts within the part `kept` of a packing of `particles`.
PartContacts contacts_within(std::span<const Contact> contacts, std::span<const int> kept, int particles);

/// Elastic tensor of the remaining packing at its own stress, per volume of the whole cell; see elastic_tensor().
/// nullopt as there, and if no particle is left.
std::optional<ElasticTensor> elastic_tensor(const Backbone& backbone);

}  // namespace isojam
