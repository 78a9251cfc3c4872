#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/contact_force.hpp"
#include "tasks/json/rows.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {

/// A contact with all exported properties. Lab frame, units of ContactForce.
struct NetworkContact {
  NeighbourPair pair;
  Alignment alignment;
  std::optional<ContactClass> contact_class;  ///< by the fits; nullopt if undecided
  ContactForce force;
};

/// Every contact of a packing, in order of (a, b, shift), classified as in the measures.
std::vector<NetworkContact> contact_network(const Packing& packing);
std::vector<NetworkContact> contact_network(const Packing& packing, const ClassifiedContacts& classified);

/// Identifies a state of a replicate in rows of contacts.
struct StateName {
  std::string replicate;
  std::size_t state = 0;  ///< index in `states` of its record
  std::optional<double> delta_phi;
};

/// Columns of contacts as rows, and the rows of one state: replicate, state, Δφ, a, b, image (of b: its centre is at
/// x_b + Σ image·(lattice vector)), V, |S|, force on a, point of attack, normal out of a, torques on a and b about
/// their centres, class by the fits, kind by the shape of the intersection, θ_ef, θ_ff (radians), depth, solids of a
/// and b.
const Columns& contact_columns();
std::string contact_lines(RowFormat format, const StateName& name, const Packing& packing);

}  // namespace isojam
