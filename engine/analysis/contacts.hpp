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

/// Class of a contact by its angles, for counting constraints: 3, 2 or 1 of them.
enum class ContactClass { face_face, edge_face, lower_order };
template <>
inline constexpr std::array enum_names<ContactClass>{EnumName{ContactClass::face_face, "face_face"},
                                                     EnumName{ContactClass::edge_face, "edge_face"},
                                                     EnumName{ContactClass::lower_order, "lower_order"}};

/// Mean contact and constraint numbers per particle, C = 3 Z_ff + 2 Z_ef + Z_l (the paper's Table III).
struct ContactNumbers {
  double Z = 0, Z_ff = 0, Z_ef = 0, Z_l = 0, C = 0;  ///< all contacts, contacts of each class, and constraints
};

/// Cut-offs between contact classes, for the contacts between solids of two shapes.
struct ClassCutoffs {
  CdfFit face_face, edge_face;            ///< fits of the distributions of θ_ff and θ_ef
  GapSplit face_face_gap, edge_face_gap;  ///< the other method, with the same windows
  CriticalAngles critical;                ///< windows end at half the smallest of these angles
};

/// Cut-offs for one pair of shapes in a mixture.
struct ShapePair {
  const ConvexSolid *a = nullptr, *b = nullptr;  ///< shapes with unit volume
  long contacts = 0;                             ///< number of contacts between solids of these shapes
  ClassCutoffs cutoffs;                          ///< cut-offs from these contacts
};

/// Result of analysing contacts. If there are several shapes, the base class has for each method the cut-off of the
/// least conclusive pair of shapes: one without a cut-off, else a doubtful one, else any.
struct ContactAnalysis : ClassCutoffs {
  std::vector<ShapePair> pairs;  ///< pairs of shapes that touch; empty if there is one shape
  /// Number of packings whose combined angles gave the fits, the gaps and hence the cut-offs. 1: only its own.
  int pooled_over = 1;
  std::vector<ContactClass> classes;     ///< class of each contact, in the given order, by the fits
  ContactNumbers numbers;                ///< numbers by the fits
  std::optional<double> Z_ff_gap;        ///< Z_ff by the gap in θ_ff; nullopt if there is no gap
  ContactNumbers fixed_cutoffs;          ///< fixed_cutoff_numbers of the contacts
  std::vector<ContactNumbers> of_kinds;  ///< per kind of a mixture; empty if all particles are identical
  /// Z_ff_gap − Z_ff; nullopt unless both methods give a cut-off.
  std::optional<double> disagreement() const;
  /// The cut-offs for contacts between solids of these shapes.
  const ClassCutoffs& cutoffs_of(const ConvexSolid& a, const ConvexSolid& b) const;
  double Q6 = 0;  ///< contact_q6 of the state; set only where the contacts are known, not just their angles
};

/// Classifies by the cut-offs of the two CDF fits, each on [0, θ_c,min/2]: face-face if θ_ff is below its cut-off, else
/// edge-face if θ_ef is below its cut-off, else lower order. A collapsed fit has the cut-off 0.
ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments);

/// The same for a packing of any solids: every pair of shapes has its own cut-offs, from its own contacts.
ContactAnalysis analyse_contacts(const Composition& solids, int particles, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments);

/// Analyses several packings with the same number of particles (replicates of a sweep point) together. Fits and gaps
/// use the angles of all packings, and each packing is classified by the common cut-offs. Results are in the given
/// order.
std::vector<ContactAnalysis> analyse_pooled(const ConvexSolid& solid, int particles,
                                            std::span<const std::vector<Alignment>> packings);

/// Means over the cut-offs 5°, 15°, ..., 55°, each used for both angles: column 2 of the paper's Table III.
ContactNumbers fixed_cutoff_numbers(int particles, std::span<const Alignment> alignments);

/// Classes for given cut-offs (radians).
std::vector<ContactClass> classify(std::span<const Alignment> alignments, double ff_cutoff, double ef_cutoff);
/// Numbers of a packing with these contacts; each contact counts for two particles. Throws std::invalid_argument if
/// particles < 1.
ContactNumbers contact_numbers(int particles, std::span<const ContactClass> classes);

}  // namespace isojam
