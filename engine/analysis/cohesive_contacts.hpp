#pragma once

#include <vector>

#include "engine/packing/cohesion.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Contacts of a packing with cohesion.
struct CohesiveContacts {
  /// Number of pairs of particles whose grown solids overlap: each of them attracts the other one. It includes all
  /// contacts.
  long grown = 0;
  /// For each contact, in the order of PackingEnergy::contacts(): true if the contact is under tension. The force on
  /// particle a then points towards b: the attraction exceeds the repulsion.
  std::vector<bool> tension;
};

/// Computes the grown contacts, and finds the contacts under tension. `contacts` are those of `packing`. Throws
/// std::invalid_argument if the cell is not legal for the grown particles (is_legal() in
/// packing/cell/periodic_cell.hpp), or if a solid cannot grow, see can_grow().
CohesiveContacts cohesive_contacts(const Packing& packing, const std::vector<Contact>& contacts,
                                   const Cohesion& cohesion);

}  // namespace isojam
