#pragma once

#include "engine/geometry/convex_solid.hpp"
#include "engine/packing/mixture/mixture.hpp"

namespace isojam {

/// Critical angles (radians) of two equal solids, as in the paper's Table II. For each pair of features that touch, for
/// example a vertex and a face, the member is the largest alignment angle that is geometrically possible. Vertices of
/// an irregular solid allow different largest angles, and so do its edges. The member is then the smallest of these, so
/// that every vertex and every edge allows all angles below it.
struct CriticalAngles {
  double ef_vertex_face = 0, ef_edge_edge = 0;  ///< θ_ef of a vertex on a face, and of two crossed edges
  /// θ_ff of a vertex on a face, of two crossed edges, and of an edge in a face
  double ff_vertex_face = 0, ff_edge_edge = 0, ff_edge_face = 0;

  double ef_min() const;  ///< smallest critical angle θ_ef
  double ff_min() const;  ///< smallest critical angle θ_ff
  /// replaces each angle by the smaller of its values in both objects
  void take_lesser(const CriticalAngles& other);
};

/// Computes the critical angles of two equal solids. If all edges and all vertices are equivalent, the angles have a
/// closed form. Otherwise they are computed by critical_angles_of_cones().
CriticalAngles critical_angles(const ConvexSolid& solid);

/// Computes the critical angles of two different solids. Let α = π/2 − δ/2 for each solid, where δ is its largest
/// dihedral angle. For crossed edges, θ_ff = arccos(cos α_A cos α_B). All other angles are the smaller of the values of
/// both solids.
CriticalAngles critical_angles(const ConvexSolid& a, const ConvexSolid& b);

/// Computes the smallest value of each critical angle over all pairs of solids in a mixture.
CriticalAngles critical_angles(const Mixture& mixture);

/// True if the solid is regular. The test is that all edges have the same dihedral angle, and all faces have the same
/// number of sides. Two more angles must be the same at all vertices. They are measured from the line through the
/// centroid and the vertex: one to the edges at the vertex, the other to the normals of the faces at the vertex.
bool has_like_features(const ConvexSolid& solid);

/// Computes the critical angles from the largest dihedral angle and the normal cones of all vertices, for any solid.
/// The normal cone of a vertex is the set of outward normals of all planes that touch the solid only at this vertex.
/// Tests use the result as the reference for the closed form.
CriticalAngles critical_angles_of_cones(const ConvexSolid& solid);

}  // namespace isojam
