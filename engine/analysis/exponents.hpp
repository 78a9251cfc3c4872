#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "engine/solve/minimise/minimise.hpp"

// Classes of contacts without a cut-off angle. A contact of the depth δ has V ~ δ^k and |S| ~ δ^(k−1), where k is 1 for
// a face on a face, 2 for an edge in a face, and 3 for a vertex in a face and for crossed edges. Its force is
// f = V|S|/2 ~ δ^(2k−1). Along a solution branch, the contact therefore has the exponent
//   x = d ln(|S|²/V) / d ln f^(1/5) = 5(k−2)/(2k−1) = −5, 0, 1.

namespace isojam {

/// Boundaries between the classes: a contact is face-face if x < face_face, otherwise edge-face if x < edge_face, and
/// otherwise of lower order.
struct ExponentBoundaries {
  double face_face = -2.5, edge_face = 0.5;
};
/// The systematic error of C is its range for these boundaries. A contact between two classes, for example an edge that
/// is tilted out of the face by about δ divided by its length, has an x between their values.
inline constexpr ExponentBoundaries fewest_constraints{-4, 0.3}, most_constraints{-1, 0.7};

/// The exponent x of a contact from its overlaps in two states of a solution branch. `mean_change` is the change of the
/// logarithm of the mean contact force between the states. It replaces that of the contact's own force if the latter is
/// less than 0.3 times as large, because such a force does not grow together with the others.
double contact_exponent(const Overlap& from, const Overlap& to, double mean_change);

/// Exponents of the contacts of an equilibrium.
struct ContactExponents {
  /// The exponent x of each contact. nullopt for the contacts that break in the step, however short, and for all
  /// contacts if no step was possible.
  std::vector<std::optional<double>> x;
  double distance = 0;  ///< Δφ of the packing, 6E/(dE/dφ); 0 without pressure
  /// Relative change of Δφ in the step from which x was computed: negative for a step of decompression, positive for a
  /// step of compression, 0 if there is none.
  double step = 0;
  int broken = 0, formed = 0;  ///< numbers of contacts that broke and formed in this step
};

/// Options of contact_exponents().
struct ExponentOptions {
  double longest_step = 0.04;  ///< length of the first steps, as a fraction of Δφ
  int lengths = 6;             ///< largest number of lengths; each is half of the one before
  /// Options of the minimisations. Few evaluations are allowed, because a step that needs more of them leads to another
  /// solution branch, or fails after all.
  MinimiseOptions minimise{.max_evaluations = 500};
};

/// Computes the exponents of the contacts of `packing`, which must be an equilibrium, from one small step at fixed cell
/// shape. Steps of decreasing length are tried, each as a decompression and as a compression, until one succeeds
/// without a change of contacts. Steps in which the packing loses energy are not used, because they contain a
/// rearrangement. If all other steps change contacts, x comes from the last of them. `contacts` are the contacts of the
/// packing in double-double, as PackingEnergy::contacts() returns them. A step takes less time than a step of the
/// decompression, because it is much shorter.
ContactExponents contact_exponents(const Packing& packing, std::span<const Contact> contacts, PackingEnergy& energy,
                                   const ExponentOptions& options = {});

/// The classes of contacts with these exponents. A contact without exponent is of lower order. A class that needs
/// faces or an edge is given only to contacts that have them (class_constraints()).
std::vector<ContactClass> classes_of(const ContactExponents& exponents, std::span<const Alignment> alignments,
                                     const ExponentBoundaries& boundaries = {});

}  // namespace isojam
