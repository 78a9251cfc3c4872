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

/// The backbone: a packing from which near-rattlers were removed. assess() finds the near-rattlers of the packing. They
/// are removed, and assess() finds the near-rattlers of the remaining particles, until there are none. The remaining
/// particles keep their poses in the same cell; they are not minimised again. `here` contains their residual. It is the
/// same as before if the removed particles carried no force.
struct Backbone {
  /// the remaining particles in their original order; if none remains, `packing` has no poses, and all other members
  /// are empty
  Packing packing;
  std::vector<int> kept{};     ///< indices of the remaining particles in the whole packing, ascending
  std::vector<int> removed{};  ///< indices of the removed particles, ascending
  int rounds = 0;              ///< number of rounds in which particles were removed
  Evaluation here{};           ///< evaluation of the remaining packing
  BlockMatrix hessian{};       ///< Hessian of the remaining packing
  SpectrumEnds ends{};         ///< modes of the remaining packing
  Stability stability{};       ///< numbers of modes of the remaining packing; it has no near-rattler
};

/// Computes the backbone of a packing.
Backbone backbone_of(const Packing& packing, const ModeOptions& options = {},
                     Precision precision = Precision::double_double);

/// The packing of some of the particles in the same cell. `kept` contains their indices, ascending.
Packing part_of(const Packing& packing, std::span<const int> kept);

/// The contacts between the particles of a part of a packing.
struct PartContacts {
  std::vector<Contact> contacts;    ///< contacts, with the indices of the particles in the part
  std::vector<std::size_t> places;  ///< index of each contact in the full list
};
/// Finds the contacts within the part `kept` of a packing with this number of particles.
PartContacts contacts_within(std::span<const Contact> contacts, std::span<const int> kept, int particles);

/// Elastic tensor of the remaining packing at its own stress, divided by the volume of the whole cell; see
/// elastic_tensor(). nullopt in the same cases, and if no particle is left.
std::optional<ElasticTensor> elastic_tensor(const Backbone& backbone);

}  // namespace isojam
