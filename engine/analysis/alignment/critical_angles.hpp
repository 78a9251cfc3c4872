#pragma once

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// Critical alignment angles (radians): the largest that each contact topology allows, for two equal solids in
/// the orientation of highest symmetry (the paper's Table II).
struct CriticalAngles {
  double ef_vertex_face = 0, ef_edge_edge = 0;
  double ff_vertex_face = 0, ff_edge_edge = 0, ff_edge_face = 0;

  double ef_min() const;  ///< least of the θ_ef
  double ff_min() const;  ///< least of the θ_ff
};

/// Returns the angles in closed form, from the dihedral angle and the vertex figure of the solid. Throws
/// std::invalid_argument if its vertices or edges are not all alike: the orientation of highest symmetry is then not
/// defined.
CriticalAngles critical_angles(const ConvexSolid& solid);

}  // namespace isojam
