#pragma once

#include <cstdint>

#include "engine/analysis/contacts.hpp"

namespace isojam {

/// Faces of A and of B that take part in a contact, as bits.
struct ContactFaces {
  std::uint64_t of_a = 0, of_b = 0;
};

/// Angles below which a face counts as parallel to a face, and an edge to a face (radians).
struct Cutoffs {
  double face_face = 0, edge_face = 0;
};

/// The faces of a contact. Face-face: the two parallel faces. Edge-face: the face, and the two faces that meet in the
/// edge. Lower order: all faces that bound the intersection. If several features are aligned, as for two solids in the
/// same orientation, those with the smallest depth are taken; the others bound the contact on its sides.
ContactFaces contact_faces(const ConvexSolid& solid_a, const ConvexSolid& solid_b, const Contact& contact,
                           ContactClass contact_class, const Cutoffs& cutoffs);

}  // namespace isojam
