#pragma once

#include <cstdint>

#include "engine/analysis/contacts.hpp"

namespace isojam {

/// Sets of the faces of A and of B that belong to a contact, as bits.
struct ContactFaces {
  std::uint64_t of_a = 0, of_b = 0;
};

/// Cut-off angles (radians) below which two faces, or an edge and a face, count as parallel.
struct Cutoffs {
  double face_face = 0, edge_face = 0;
};

/// Finds the faces of a contact. For a face-face contact, these are the two parallel faces. For an edge-face contact,
/// these are the face, and the two faces that meet in the edge. For a lower-order contact, these are all faces that
/// bound the intersection. If several features are aligned, as for two solids in the same orientation, the features
/// with the smallest depth are taken, because the others bound the intersection at its sides.
ContactFaces contact_faces(const ConvexSolid& solid_a, const ConvexSolid& solid_b, const Contact& contact,
                           ContactClass contact_class, const Cutoffs& cutoffs);

}  // namespace isojam
