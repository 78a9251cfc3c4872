#pragma once

#include <span>
#include <vector>

#include "engine/geometry/hull.hpp"
#include "engine/geometry/quad.hpp"

namespace isojam {

/// The plane n·y = offset through a face. n is the outward unit normal.
struct FacePlane {
  Quad3 normal{};   ///< outward unit normal n
  Quad offset = 0;  ///< offset n·y
};

/// Newell's plane through a face: the normal is the sum of the vector products of successive corners, and the plane
/// contains the mean of the corners. It is exact for a planar polygon, and a fit for other ones.
FacePlane fitted_plane(const FaceLoop& face, std::span<const Quad3> vertices);

/// Largest move of a vertex to make faces planar, relative to the tolerance within which vertices form a face.
inline constexpr double largest_planar_move = 4;

/// A polyhedron with planar faces. with_planar_faces() below defines its size.
struct PlanarSolid {
  std::vector<Quad3> vertices;  ///< vertices that are in the planes of their faces within 1e-30 of the size
  Quad largest_distance = 0;    ///< largest distance of a vertex from a fitted plane before the change
  Quad largest_move = 0;        ///< largest distance between a vertex and its original
};

/// Moves the vertices of a convex polyhedron so that all faces are exactly planar. Vertices whose distances from the
/// fitted planes are at most 1e-30 of the size are returned unchanged. The size is the largest distance of a vertex
/// from the mean of all vertices.
///
/// The unknowns are all vertices v and all planes (n, d). The equations are the incidences g = n·v − d = 0, one for
/// each corner of each face, which makes 2E equations for E edges. Their Jacobian with respect to all unknowns has full
/// rank for every 3-polytope: polyhedra of one combinatorial type are a smooth manifold of dimension E + 6 (Steinitz
/// and Rademacher 1934; Richter-Gebert, Realization Spaces of Polytopes, 1996). The function solves them with steps of
/// least norm,
///
///     (δv, δn, δd) = −Jᵀ (J Jᵀ)⁻¹ g,
///
/// with lengths in units of the size. J Jᵀ is factorised in double, and g is computed in quadruple precision. To first
/// order, the result is thus the nearest polyhedron of this type in the norm of all unknowns. After each step, g is
/// about 1e-13 times its previous value, or about the square of the last move if that is larger.
///
/// Throws NoSolid if the steps do not converge, if a vertex would move by more than `allowed_move` (in the unit of the
/// vertices), or if the result is not convex.
PlanarSolid with_planar_faces(std::span<const Quad3> vertices, std::span<const FaceLoop> faces, Quad allowed_move);

}  // namespace isojam
