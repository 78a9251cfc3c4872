#pragma once

#include <span>
#include <vector>

#include "engine/packing/energy.hpp"

namespace isojam {

/// Alignment angles θ_ff and θ_ef of a contact (as in the paper, radians), and the features that determine them.
struct Alignment {
  double face_face = 0;  ///< θ_ff = π − arccos(min n_i·n_j) over the faces of the intersection, from cross products
  double edge_face = 0;          ///< θ_ef = arcsin(min |e·n|), the smaller one of A's edges on B and B's edges on A
  int face_a = -1, face_b = -1;  ///< faces of θ_ff
  int edge = -1, face = -1;      ///< edge and face of θ_ef; −1 if no edge has a segment inside the other body
  bool edge_of_a = true;         ///< true if the edge belongs to A and the face to B; false for the opposite case
};

/// The angles of one contact. θ_ef = π/2 if no edge of either body has a segment inside the other. θ_ff = π if a body
/// has no face in the contact (one inside the other).
Alignment alignment(const ConvexSolid& a, const ConvexSolid& b, const Contact& contact);
/// The angles of a contact of two equal solids.
inline Alignment alignment(const ConvexSolid& solid, const Contact& contact) {
  return alignment(solid, solid, contact);
}

/// Alignments of all contacts, in their order.
std::vector<Alignment> alignments(const Composition& solids, std::span<const Contact> contacts);

}  // namespace isojam
