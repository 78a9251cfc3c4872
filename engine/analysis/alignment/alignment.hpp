#pragma once

#include <span>
#include <vector>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Alignment angles θ_ff and θ_ef of a contact as in the paper, in radians, and the faces and the edge that determine
/// them.
struct Alignment {
  /// θ_ff = π − arccos(min n_i·n_j), over the faces i of A and j of B that bound the intersection, with outward normals
  /// n
  double face_face = 0;
  /// θ_ef = arcsin(min |e·n|), where e is the unit vector along an edge of one solid, and n the normal of a face of the
  /// other solid. Only edges with a segment inside the other solid and faces that bound the intersection are used.
  double edge_face = 0;
  int face_a = -1, face_b = -1;  ///< indices of the two faces of θ_ff; −1 if there is no such face
  /// indices of the edge and of the face of θ_ef; −1 if there is no such pair
  int edge = -1, face = -1;
  /// true if the edge belongs to A and the face to B; false if the edge belongs to B and the face to A
  bool edge_of_a = true;
};

/// Computes the angles of one contact. θ_ff is π if no face of A or no face of B bounds the intersection, because one
/// solid is inside the other. θ_ef is then π/2. It is also π/2 if no edge has a segment inside the other solid.
Alignment alignment(const ConvexSolid& a, const ConvexSolid& b, const Contact& contact);
/// Computes the angles of a contact of two particles with the same solid.
inline Alignment alignment(const ConvexSolid& solid, const Contact& contact) {
  return alignment(solid, solid, contact);
}

/// Computes the angles of all contacts, in the order of `contacts`.
std::vector<Alignment> alignments(const Composition& solids, std::span<const Contact> contacts);

}  // namespace isojam
