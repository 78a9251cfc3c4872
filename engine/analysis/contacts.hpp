#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/analysis/alignment/alignment.hpp"
#include "engine/analysis/alignment/cdf_fit.hpp"
#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Class of a contact, from its alignment angles. A face_face contact counts as 3 constraints, an edge_face contact as
/// 2, and a lower_order contact as 1.
enum class ContactClass { face_face, edge_face, lower_order };
template <>
inline constexpr std::array enum_names<ContactClass>{EnumName{ContactClass::face_face, "face_face"},
                                                     EnumName{ContactClass::edge_face, "edge_face"},
                                                     EnumName{ContactClass::lower_order, "lower_order"}};

/// Contact numbers Z and constraint number C = 3 Z_ff + 2 Z_ef + Z_l, per particle (the paper's Table III).
struct ContactNumbers {
  /// numbers of all contacts, of each class, and of constraints
  double Z = 0, Z_ff = 0, Z_ef = 0, Z_l = 0, C = 0;
};

/// Cut-offs that separate the contact classes, for the contacts between solids of two shapes.
struct ClassCutoffs {
  CdfFit face_face, edge_face;  ///< fits of the distributions of θ_ff and of θ_ef
  /// critical angles; angles above half of the smallest critical angle are not used for the cut-offs
  CriticalAngles critical;
};

/// Cut-offs for the contacts between solids of two shapes in a mixture.
struct ShapePair {
  const ConvexSolid *a = nullptr, *b = nullptr;  ///< the two shapes, as solids of unit volume
  long contacts = 0;                             ///< number of contacts between solids of these shapes
  ClassCutoffs cutoffs;                          ///< cut-offs from these contacts
};

/// Result of analyse_contacts(). If particles have several shapes, `pairs` contains the cut-offs of each pair of
/// shapes, and the members of the base class summarise them: the smallest critical angles of all pairs, and the fit of
/// the least conclusive pair, which is one without a cut-off, otherwise one with a doubtful fit, otherwise any.
struct ContactAnalysis : ClassCutoffs {
  std::vector<ShapePair> pairs;  ///< pairs of shapes that have contacts; empty if there is only one shape
  /// class of each contact from the fitted cut-offs, in the order of the contacts
  std::vector<ContactClass> classes;
  ContactNumbers numbers;        ///< contact and constraint numbers from the fitted cut-offs
  ContactNumbers fixed_cutoffs;  ///< result of fixed_cutoff_numbers()
  /// contact and constraint numbers for the particles of each kind of a mixture; empty if all particles are identical
  std::vector<ContactNumbers> of_kinds;
  /// The cut-offs for contacts between the shapes `a` and `b`, which are objects that Composition::unit() returned. If
  /// this pair has no contacts, the result is the summary in this object.
  const ClassCutoffs& cutoffs_of(const ConvexSolid& a, const ConvexSolid& b) const;
  /// Steinhardt's Q6 of the contacts. The functions below do not set it; the caller can set it to contact_q6().
  double Q6 = 0;
};

/// Classifies the contacts of a packing of equal solids. The cut-offs are fitted to the distributions of both angles,
/// from 0 to half of the smallest critical angle. A contact is face-face if θ_ff is below its cut-off. Otherwise it is
/// edge-face if θ_ef is below its cut-off, and of lower order if not. If the fit for a class finds no cut-off, the
/// cut-off is 0, so no contact is in this class.
ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments);

/// Classifies the contacts of a packing with any solids. Each pair of shapes has its own cut-offs, which are fitted to
/// the contacts between these two shapes.
ContactAnalysis analyse_contacts(const Composition& solids, int particles, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments);

/// Numbers with fixed cut-offs instead of fitted ones: the mean over the cut-offs 5°, 15°, …, 55° for both angles, as
/// in column 2 of the paper's Table III.
ContactNumbers fixed_cutoff_numbers(int particles, std::span<const Alignment> alignments);

/// Classes of the contacts for given cut-offs (radians).
std::vector<ContactClass> classify(std::span<const Alignment> alignments, double ff_cutoff, double ef_cutoff);
/// Contact and constraint numbers per particle for contacts of these classes, such as Z = 2 × contacts / particles.
/// Throws std::invalid_argument if particles < 1.
ContactNumbers contact_numbers(int particles, std::span<const ContactClass> classes);

}  // namespace isojam
