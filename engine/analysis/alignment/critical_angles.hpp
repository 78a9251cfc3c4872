#pragma once

#include "engine/geometry/convex_solid.hpp"
#include "engine/packing/mixture/mixture.hpp"

namespace isojam {

/// Critical alignment angles (radians): the largest that each contact topology allows, for two equal solids in
/// the orientation of highest symmetry (the paper's Table II). Where vertices or edges are not all alike, the least of
/// what each of them allows in its own best orientation: below it, no feature of the solid keeps an angle from a
/// contact.
struct CriticalAngles {
  double ef_vertex_face = 0, ef_edge_edge = 0;  ///< θ_ef of a vertex on a face, and of two edges crossed
  double ff_vertex_face = 0, ff_edge_edge = 0, ff_edge_face = 0;  ///< θ_ff of these, and of an edge in a face

  double ef_min() const;                          ///< least of the θ_ef
  double ff_min() const;                          ///< least of the θ_ff
  void take_lesser(const CriticalAngles& other);  ///< of each
};

/// Returns the angles: in closed form, from the dihedral angle and the vertex figure, where edges and vertices are all
/// alike; from the widest dihedral angle and the cones of normals of all vertices otherwise.
CriticalAngles critical_angles(const ConvexSolid& solid);

/// Of two solids: the least that either allows in the other's face, and where edges cross, with half-angles α = π/2 −
/// δ/2 of the widest dihedral angles δ, θ_ff = arccos(cos α_A cos α_B) and the lesser α as θ_ef.
CriticalAngles critical_angles(const ConvexSolid& a, const ConvexSolid& b);

/// The least of each over all pairs of the solids of a mixture.
CriticalAngles critical_angles(const Mixture& mixture);

/// Whether vertices, edges and faces are all alike, as far as angles at them and numbers of sides tell: a regular
/// solid.
bool has_like_features(const ConvexSolid& solid);

/// The second way, for any solid: the oracle of the first.
CriticalAngles critical_angles_of_cones(const ConvexSolid& solid);

}  // namespace isojam
