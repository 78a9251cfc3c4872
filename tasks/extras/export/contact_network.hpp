#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/contact_force.hpp"
#include "tasks/io/rows.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {

/// A contact with all exported properties, in the lab frame and in the units of ContactForce.
struct NetworkContact {
  NeighbourPair pair;
  Alignment alignment;
  std::optional<ContactClass> contact_class;  ///< class by the fitted cut-offs; nullopt if the classes are undecided
  ContactForce force;
};

/// All contacts of a packing, sorted by (a, b, shift), classified as in the measures.
std::vector<NetworkContact> contact_network(const Packing& packing);
std::vector<NetworkContact> contact_network(const Packing& packing, const ClassifiedContacts& classified);

/// Identifies a state of a replicate in rows of contacts.
struct StateName {
  std::string replicate;
  std::size_t state = 0;  ///< index of the state in the list `states` of the record
  std::optional<double> delta_phi;
};

/// The columns of a table of contacts, and the rows of one state. Columns: replicate, state, Δφ, a, b, image (the
/// centre of the image of b is x_b + Σ image·(lattice vector)), V, |S|, force on a, point of application, normal that
/// points out of a, torques on a and b about their centres, class by the fitted cut-offs, kind by the shape of the
/// intersection, θ_ef, θ_ff (radians), depth, solids of a and b.
const Columns& contact_columns();
std::string contact_lines(RowFormat format, const StateName& name, const Packing& packing);

}  // namespace isojam
