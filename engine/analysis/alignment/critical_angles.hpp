#pragma once

#include "engine/geometry/convex_solid.hpp"
#include "engine/packing/mixture/mixture.hpp"

namespace isojam {

/// Critical alignment angles (radians): the largest angles that each contact topology allows, for two equal solids in
/// the orientation of highest symmetry (the paper's Table II). If the vertices or edges of a solid are not equivalent,
/// the largest angle is computed for each vertex or edge in its best orientation, and the critical angle is the
/// smallest of these. All vertices and edges of the solid then allow every angle below the critical angle.
struct CriticalAngles {
  double ef_vertex_face = 0, ef_edge_edge = 0;  ///< θ_ef of a vertex on a face, and of two crossed edges
  /// θ_ff of a vertex on a face, of two crossed edges, and of an edge in a face
  double ff_vertex_face = 0, ff_edge_edge = 0, ff_edge_face = 0;

  double ef_min() const;                          ///< the smallest critical angle θ_ef
  double ff_min() const;                          ///< the smallest critical angle θ_ff
  void take_lesser(const CriticalAngles& other);  ///< replaces each angle by the smaller value of both objects
};

/// Computes the critical angles of two equal solids. If all edges and all vertices are equivalent, the angles have a
/// closed form with the dihedral angle and the vertex figure. Otherwise they are computed from the largest dihedral
/// angle and the normal cones of all vertices.
CriticalAngles critical_angles(const ConvexSolid& solid);

/// Computes the critical angles of two different solids. For contacts with a face, it is the smaller value of the two
/// solids. For crossed edges, θ_ff = arccos(cos α_A cos α_B), and θ_ef is the smaller of α_A and α_B. Here α = π/2 −
/// δ/2, where δ is the largest dihedral angle of the solid.
CriticalAngles critical_angles(const ConvexSolid& a, const ConvexSolid& b);

/// Computes the smallest value of each critical angle over all pairs of solids in a mixture.
CriticalAngles critical_angles(const Mixture& mixture);

/// True for a regular solid. The test is whether all vertices, edges and faces have the same angles and numbers of
/// sides.
bool has_like_features(const ConvexSolid& solid);

/// Computes the critical angles with the method of normal cones, which applies to any solid. Tests use it as the
/// reference for the closed form.
CriticalAngles critical_angles_of_cones(const ConvexSolid& solid);

}  // namespace isojam
