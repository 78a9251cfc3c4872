#include "engine/analysis/cohesive_contacts.hpp"

#include <algorithm>
#include <cassert>

namespace isojam {

CohesiveContacts cohesive_contacts(const Packing& packing, const std::vector<Contact>& contacts,
                                   const Cohesion& cohesion) {
  const Packing grown_packing{grown(packing.solids, packing.size(), cohesion.range / 2), packing.cell, packing.poses};
  PackingEnergy energy;
  const std::vector<Contact> all = energy.contacts(grown_packing);
  CohesiveContacts result;
  result.grown = static_cast<long>(all.size());
  auto at = all.begin();  // both lists are sorted
  for (const Contact& contact : contacts) {
    const auto key = canonical_key(contact.pair);
    at = std::find_if(at, all.end(), [&](const Contact& candidate) { return canonical_key(candidate.pair) == key; });
    assert(at != all.end());
    const Eigen::Vector3d force =
        cohesion.strength * at->overlap.area - contact.overlap.volume / 2 * contact.overlap.area;
    result.tension.push_back(force.dot(contact.overlap.area) > 0);
  }
  return result;
}

}  // namespace isojam
