#pragma once

#include <cstdint>

#include "engine/analysis/contacts.hpp"

namespace isojam {

/// Faces of A and of B, as bits, that a contact takes place on.
struct ContactFaces {
  std::uint64_t of_a = 0, of_b = 0;
};

/// Angles below which a face lies in a face, and an edge in a face (radians).
struct Cutoffs {
  double face_face = 0, edge_face = 0;
};

/// Face-face: the two faces that lie in each other; edge-face: the face, and the two that meet in the edge; lower
/// order: all that bound the intersection. Where several features are aligned, as of two solids in the same
/// orientation, those are meant that are pressed into each other least: the others bound the contact on its sides.
ContactFaces contact_faces(const ConvexSolid& solid_a, const ConvexSolid& solid_b, const Contact& contact,
                           ContactClass contact_class, const Cutoffs& cutoffs);

}  // namespace isojam
