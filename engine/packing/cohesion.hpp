#pragma once

#include "engine/packing/mixture/composition.hpp"

namespace isojam {

/// Cohesion: a short-ranged attraction between particles, as it arises from depletion. Each pair has the additional
/// energy −w V_h. V_h is the overlap volume of the two grown solids: all faces of a grown solid are moved outwards by
/// h/2.
struct Cohesion {
  double range = 0.1;   ///< h > 0, in units of V_p^(1/3)
  double strength = 0;  ///< w ≥ 0, in units of Y; 0: no cohesion

  bool acts() const { return strength > 0; }  ///< true if there is cohesion

  bool operator==(const Cohesion& other) const = default;
};

/// True if all faces have the same distance from the centroid, as in a Platonic solid. If such a solid grows, its shape
/// does not change.
bool can_grow(const ConvexSolid& solid);

/// The solids of all particles with all faces moved outwards by `distance` (V_p^(1/3)). Throws std::invalid_argument
/// unless can_grow() is true for all solids.
Composition grown(const Composition& solids, int particles, double distance);

}  // namespace isojam
