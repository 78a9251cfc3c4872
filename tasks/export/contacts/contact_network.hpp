#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/contact_force.hpp"
#include "tasks/json/rows.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {

/// A contact with all that leaves the program about it. Lab frame, units of ContactForce.
struct NetworkContact {
  NeighbourPair pair;
  Alignment alignment;
  std::optional<ContactClass> contact_class;  ///< by the fits; none if they are undecided
  ContactForce force;
};

/// Every contact of a packing, in order of (a, b, shift), classified as the measurements do, or have.
std::vector<NetworkContact> contact_network(const Packing& packing);
std::vector<NetworkContact> contact_network(const Packing& packing, const ClassifiedContacts& classified);

/// A state of a replicate, as its contacts name it.
struct StateName {
  std::string replicate;
  std::size_t state = 0;  ///< index in `states` of its record
  std::optional<double> delta_phi;
};

/// Columns of contacts as rows, and the rows of a state's: replicate, state, Δφ, a, b, image (of b: its centre is at
/// x_b + Σ image·(lattice vector)), V, |S|, force on a, point of attack, normal out of a, torques on a and b about
/// their centres, class by the fits, kind by what the intersection is, θ_ef, θ_ff (radians), depth, solids of a and b.
const Columns& contact_columns();
std::string contact_lines(RowFormat format, const StateName& name, const Packing& packing);

}  // namespace isojam
