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

/// A packing without its near-rattlers: what is left when those are taken away that assess() names, and those that it
/// names in the rest, until it names none. The rest stands where it stood, in the same cell, and is not minimised anew:
/// `here` tells how far it is from balance, which is as far as before if what went carried no force.
struct Backbone {
  Packing packing;             ///< what is left, in its order; no poses if that is nothing, and what follows is empty
  std::vector<int> kept{};     ///< its numbers in the whole, ascending
  std::vector<int> removed{};  ///< the others, ascending
  int rounds = 0;              ///< in which some were taken away
  Evaluation here{};           ///< of what is left, as the rest of these
  BlockMatrix hessian{};       ///< of what is left
  SpectrumEnds ends{};         ///< its modes
  Stability stability{};       ///< counts of its modes, and that no near-rattler is left
};

/// Takes near-rattlers away until none is named.
Backbone backbone_of(const Packing& packing, const ModeOptions& options = {},
                     Precision precision = Precision::double_double);

/// Some particles of a packing, numbers ascending, in its cell.
Packing part_of(const Packing& packing, std::span<const int> kept);

/// The contacts between these, with their numbers in that part, and the places of those contacts in the list.
struct PartContacts {
  std::vector<Contact> contacts;    ///< numbered as in the part
  std::vector<std::size_t> places;  ///< of each in the list of all
};
/// Of the part with these particles of so many.
PartContacts contacts_within(std::span<const Contact> contacts, std::span<const int> kept, int particles);

/// Elastic tensor of what is left alone: elastic_tensor() of it, at its own stress, per volume of the whole cell.
/// nullopt as there, and if nothing is left.
std::optional<ElasticTensor> elastic_tensor(const Backbone& backbone);

}  // namespace isojam
