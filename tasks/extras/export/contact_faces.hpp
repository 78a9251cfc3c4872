#pragma once

#include "engine/analysis/contacts.hpp"

namespace isojam {

/// The faces of A and of B that belong to a contact.
struct ContactFaces {
  FeatureSet of_a{}, of_b{};
};

/// Cut-offs (radians) of the angle between two faces, and of the angle between an edge and a face.
struct Cutoffs {
  double face_face = 0, edge_face = 0;
};

/// Finds the faces of a contact.
/// - For a face-face contact, these are its two faces.
/// - For an edge-face contact, these are the face, and the two faces that meet at the edge.
/// - For a lower-order contact, these are all faces that bound the intersection.
///
/// Several pairs of features may have alignment angles below the cut-off, for example if both solids have the same
/// orientation. The pair with the smallest depth then counts, because the others bound the intersection at its sides.
ContactFaces contact_faces(const ConvexSolid& solid_a, const ConvexSolid& solid_b, const Contact& contact,
                           ContactClass contact_class, const Cutoffs& cutoffs);

}  // namespace isojam
