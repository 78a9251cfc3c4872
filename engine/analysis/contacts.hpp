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

/// Class of a contact by its alignment angles. A face_face contact counts as 3 constraints, an edge_face contact as 2,
/// and a lower_order contact as 1.
enum class ContactClass { face_face, edge_face, lower_order };
template <>
inline constexpr std::array enum_names<ContactClass>{EnumName{ContactClass::face_face, "face_face"},
                                                     EnumName{ContactClass::edge_face, "edge_face"},
                                                     EnumName{ContactClass::lower_order, "lower_order"}};

/// Contact numbers Z and constraint number C per particle, C = 3 Z_ff + 2 Z_ef + Z_l (the paper's Table III).
struct ContactNumbers {
  double Z = 0, Z_ff = 0, Z_ef = 0, Z_l = 0, C = 0;  ///< all contacts, the contacts of each class, and constraints
};

/// Cut-offs between the contact classes, for the contacts between solids of two shapes.
struct ClassCutoffs {
  CdfFit face_face, edge_face;  ///< fits of the distributions of θ_ff and θ_ef
  /// cut-offs by another method, a gap between the angles, from the same windows of angles
  GapSplit face_face_gap, edge_face_gap;
  CriticalAngles critical;  ///< critical angles; a window of angles ends at half of the smallest of them
};

/// Cut-offs for the contacts between two shapes in a mixture.
struct ShapePair {
  const ConvexSolid *a = nullptr, *b = nullptr;  ///< the two shapes, solids with unit volume
  long contacts = 0;                             ///< number of contacts between solids of these shapes
  ClassCutoffs cutoffs;                          ///< cut-offs from these contacts
};

/// Result of analyse_contacts(). If particles have several shapes, each pair of shapes has its own cut-offs in `pairs`.
/// The base class then has, for each method, the result of the least conclusive pair of shapes: a pair without a
/// cut-off if there is one, else a pair with a doubtful cut-off if there is one, else any pair.
struct ContactAnalysis : ClassCutoffs {
  std::vector<ShapePair> pairs;  ///< pairs of shapes that have contacts; empty if there is only one shape
  /// Number of packings whose angles were combined to find the fits, the gaps and the cut-offs. 1: only this packing.
  int pooled_over = 1;
  std::vector<ContactClass> classes;  ///< class of each contact by the fitted cut-offs, in the order of the contacts
  ContactNumbers numbers;             ///< contact and constraint numbers by the fitted cut-offs
  /// Z_ff with the cut-off in the gap between the angles θ_ff; nullopt if there is no gap
  std::optional<double> Z_ff_gap;
  ContactNumbers fixed_cutoffs;  ///< result of fixed_cutoff_numbers()
  /// numbers for the particles of each kind of a mixture; empty if all particles are identical
  std::vector<ContactNumbers> of_kinds;
  /// Difference Z_ff_gap − Z_ff; nullopt unless both methods give a cut-off.
  std::optional<double> disagreement() const;
  /// The cut-offs for contacts between solids with the shapes of a and b.
  const ClassCutoffs& cutoffs_of(const ConvexSolid& a, const ConvexSolid& b) const;
  /// Steinhardt's Q6 of the contacts; set only by functions that receive the contacts, not only their angles
  double Q6 = 0;
};

/// Fits the distributions of both angles on [0, θ_c,min/2], and classifies the contacts by the cut-offs. A contact is
/// face-face if θ_ff is below its cut-off. Otherwise it is edge-face if θ_ef is below its cut-off. All other contacts
/// are of lower order. A collapsed fit has the cut-off 0.
ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments);

/// Classifies the contacts of a packing with any solids. Each pair of shapes has its own cut-offs, fitted to the
/// contacts between these two shapes.
ContactAnalysis analyse_contacts(const Composition& solids, int particles, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments);

/// Analyses several packings with the same number of particles together, for example the replicates of a sweep point.
/// The fits and gaps use the angles of all packings. The contacts of each packing are classified by these common
/// cut-offs. The results are in the order of `packings`.
std::vector<ContactAnalysis> analyse_pooled(const ConvexSolid& solid, int particles,
                                            std::span<const std::vector<Alignment>> packings);

/// Numbers with fixed cut-offs instead of fitted ones: the means over the cut-offs 5°, 15°, ..., 55°, each used for
/// both angles. This is column 2 of the paper's Table III.
ContactNumbers fixed_cutoff_numbers(int particles, std::span<const Alignment> alignments);

/// Classes of the contacts for given cut-offs (radians).
std::vector<ContactClass> classify(std::span<const Alignment> alignments, double ff_cutoff, double ef_cutoff);
/// Contact and constraint numbers of a packing with contacts of these classes. Each contact counts for two particles.
/// Throws std::invalid_argument if particles < 1.
ContactNumbers contact_numbers(int particles, std::span<const ContactClass> classes);

}  // namespace isojam
