#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/analysis/alignment/alignment.hpp"
#include "engine/analysis/alignment/cdf_fit.hpp"
#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/analysis/alignment/gap_split.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Class of a contact by its angles, as counting constraints has it: 3, 2 and 1 of them.
enum class ContactClass { face_face, edge_face, lower_order };
template <>
inline constexpr std::array enum_names<ContactClass>{EnumName{ContactClass::face_face, "face_face"},
                                                     EnumName{ContactClass::edge_face, "edge_face"},
                                                     EnumName{ContactClass::lower_order, "lower_order"}};

/// Mean contact and constraint numbers per particle, C = 3 Z_ff + 2 Z_ef + Z_l (the paper's Table III).
struct ContactNumbers {
  double Z = 0, Z_ff = 0, Z_ef = 0, Z_l = 0, C = 0;  ///< contacts of all classes, of each, and constraints
};

/// Cut-offs between contact classes, of all contacts between solids of two shapes.
struct ClassCutoffs {
  CdfFit face_face, edge_face;            ///< fits of the distributions of θ_ff and θ_ef
  GapSplit face_face_gap, edge_face_gap;  ///< the other method, in the same windows
  CriticalAngles critical;                ///< windows end at half the least of them
};

/// The cut-offs of one pair of shapes in a mixture of several.
struct ShapePair {
  const ConvexSolid *a = nullptr, *b = nullptr;  ///< of unit volume
  long contacts = 0;                             ///< between solids of these shapes
  ClassCutoffs cutoffs;                          ///< that their contacts gave
};

/// Where there are several shapes, the base has for each method the cut-off of the pair of shapes that decides least:
/// without one, or else doubtful, or else any.
struct ContactAnalysis : ClassCutoffs {
  std::vector<ShapePair> pairs;  ///< of shapes that touch; none if there is one shape
  /// Packings whose angles, taken together, gave the fits, the gaps and so the cut-offs. 1: its own alone.
  int pooled_over = 1;
  std::vector<ContactClass> classes;     ///< per contact, in the order given, by the fits
  ContactNumbers numbers;                ///< by the fits
  std::optional<double> Z_ff_gap;        ///< Z_ff by the gap in θ_ff; none if there is no gap
  ContactNumbers fixed_cutoffs;          ///< fixed_cutoff_numbers of the contacts
  std::vector<ContactNumbers> of_kinds;  ///< of the particles of each kind of a mixture; none if they are alike
  /// Z_ff_gap − Z_ff; none unless the fit gives a cut-off too.
  std::optional<double> disagreement() const;
  /// The cut-offs of contacts between solids of these shapes.
  const ClassCutoffs& cutoffs_of(const ConvexSolid& a, const ConvexSolid& b) const;
  double Q6 = 0;  ///< contact_q6 of the state, for whoever has its contacts and not just their angles
};

/// Classifies by the cut-offs of the two CDF fits on [0, θ_c,min/2] each: face-face if θ_ff < its cut-off,
/// edge-face if θ_ef < its cut-off and not face-face, lower order otherwise. A collapsed fit leaves its cut-off at 0.
ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments);

/// The same of a packing of any solids: every pair of shapes has cut-offs of its own, each found from its contacts
/// alone.
ContactAnalysis analyse_contacts(const Composition& solids, int particles, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments);

/// Analyses several packings of as many particles each (replicates of a sweep point) together: fits and gaps are found
/// from the angles of all, and each packing is classified by the common cut-offs. Results in the order given.
std::vector<ContactAnalysis> analyse_pooled(const ConvexSolid& solid, int particles,
                                            std::span<const std::vector<Alignment>> packings);

/// Means over the cut-offs 5°, 15°, ..., 55°, each used for both angles: column 2 of the paper's Table III.
ContactNumbers fixed_cutoff_numbers(int particles, std::span<const Alignment> alignments);

/// Classes for given cut-offs (radians).
std::vector<ContactClass> classify(std::span<const Alignment> alignments, double ff_cutoff, double ef_cutoff);
/// Numbers of a packing with these contacts; each counts for two particles.
/// Throws std::invalid_argument if particles < 1.
ContactNumbers contact_numbers(int particles, std::span<const ContactClass> classes);

}  // namespace isojam
