#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/contact_force.hpp"
#include "tasks/extras/export/stored_states.hpp"
#include "tasks/io/rows.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {

/// A contact with all exported properties. Vectors are in the lab frame, and units are those of ContactForce.
struct NetworkContact {
  NeighbourPair pair;
  Alignment alignment;
  std::optional<ContactClass> contact_class;  ///< class of the contact; nullopt if a fit found no cut-off
  ContactForce force;                         ///< zero if the particles do not overlap
  double gap = 0;                             ///< gap of a pair that does not overlap; otherwise 0
};

/// All contacts of a packing, sorted by (a, b, shift), with the classes of the measure `contacts`.
std::vector<NetworkContact> contact_network(const Packing& packing, const ClassifiedContacts& classified);

/// Columns of a table of contacts: replicate, state, Δφ, a, b, image, V, |S|, force on a, point of application, normal
/// (points out of a), torques on a and b about their centres, class, kind, θ_ef and θ_ff (radians), depth, solids of a
/// and b, the exponent x, which is empty unless the record has the measure `exponents` of the state, and the gap.
/// `image` has three integers n_i: the centre of the touching image of b is x_b + Σ n_i·(lattice vector i). The class
/// depends on the fitted cut-offs, and the kind on the shape of the intersection, see ContactKind.
const Columns& contact_columns();
/// The columns with texts.
const Columns& contact_texts();
/// The rows of all contacts of one state.
std::string contact_lines(RowFormat format, const std::string& replicate, const StoredState& state);

}  // namespace isojam
