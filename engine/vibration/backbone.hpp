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

/// The backbone: a packing from which near-rattlers were removed. assess() finds the near-rattlers of the packing, and
/// they are removed. This is repeated with the remaining particles until assess() finds no near-rattler. The remaining
/// particles keep their poses in the same cell; they are not minimised again. `here` contains their residual, which is
/// the same as before if the removed particles carried no force.
struct Backbone {
  /// the remaining particles in their original order. If no particle remains, `packing` has no poses, and the members
  /// after `rounds` are empty.
  Packing packing;
  std::vector<int> kept{};     ///< indices of the remaining particles in the whole packing, ascending
  std::vector<int> removed{};  ///< indices of the removed particles, ascending
  int rounds = 0;              ///< number of rounds in which particles were removed
  Evaluation here{};           ///< evaluation of the remaining packing
  BlockMatrix hessian{};       ///< Hessian of the remaining packing
  SpectrumEnds ends{};         ///< lowest and highest modes of the remaining packing
  Stability stability{};       ///< stability of the remaining packing; it contains no near-rattler
};

/// Computes the backbone of a packing.
Backbone backbone_of(const Packing& packing, const ModeOptions& options = {},
                     Precision precision = Precision::double_double);

/// The packing that consists of some of the particles, in the same cell. `kept` contains their indices, ascending.
Packing part_of(const Packing& packing, std::span<const int> kept);

/// The contacts between the particles of a part of a packing, see part_of().
struct PartContacts {
  std::vector<Contact> contacts;    ///< the contacts; their particles have the indices that they have in the part
  std::vector<std::size_t> places;  ///< index of each contact in the list of the whole packing
};
/// Finds the contacts in which both particles are in `kept`. `particles` is the number of particles of the whole
/// packing.
PartContacts contacts_within(std::span<const Contact> contacts, std::span<const int> kept, int particles);

/// The elastic tensor of the backbone at its own stress: elastic_tensor() with the remaining particles and the volume
/// of the whole cell. nullopt if elastic_tensor() returns nullopt, or if no particle remains.
std::optional<ElasticTensor> elastic_tensor(const Backbone& backbone);

}  // namespace isojam
