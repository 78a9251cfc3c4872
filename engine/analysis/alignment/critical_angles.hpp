#pragma once

#include "engine/geometry/convex_solid.hpp"
#include "engine/packing/mixture/mixture.hpp"

namespace isojam {

/// Critical alignment angles (radians): the largest angle that each contact topology allows, for two equal solids in
/// the orientation of highest symmetry (the paper's Table II). If vertices or edges differ, it is the smallest of the
/// angles that each allows in its own best orientation; below it, no feature of the solid excludes an angle.
struct CriticalAngles {
  double ef_vertex_face = 0, ef_edge_edge = 0;  ///< θ_ef of a vertex on a face, and of two crossed edges
  double ff_vertex_face = 0, ff_edge_edge = 0, ff_edge_face = 0;  ///< θ_ff of these, and of an edge in a face

  double ef_min() const;                          ///< smallest of the θ_ef
  double ff_min() const;                          ///< smallest of the θ_ff
  void take_lesser(const CriticalAngles& other);  ///< takes the smaller value of each angle
};

/// The critical angles. If all edges and all vertices are equivalent, they follow in closed form from the dihedral
/// angle and the vertex figure. Otherwise they follow from the largest dihedral angle and the normal cones of all
/// vertices.
CriticalAngles critical_angles(const ConvexSolid& solid);

/// Critical angles of two solids. For contacts with a face: the smaller value of both. For crossed edges, with
/// half-angles α = π/2 − δ/2 of the largest dihedral angles δ: θ_ff = arccos(cos α_A cos α_B), and θ_ef is the smaller
/// α.
CriticalAngles critical_angles(const ConvexSolid& a, const ConvexSolid& b);

/// The smallest value of each angle over all pairs of solids in a mixture.
CriticalAngles critical_angles(const Mixture& mixture);

/// True for a regular solid: all vertices, edges and faces have the same angles and numbers of sides.
bool has_like_features(const ConvexSolid& solid);

/// The second method, which applies to any solid: the test oracle of the first.
CriticalAngles critical_angles_of_cones(const ConvexSolid& solid);

}  // namespace isojam
