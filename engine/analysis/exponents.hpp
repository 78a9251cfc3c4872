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
  double step = 0;            ///< length of the step from which x was computed, as a fraction of Δφ; 0 if there is none
  int broken = 0, formed = 0; ///< numbers of contacts that broke and formed in this step
  int attempts = 0;           ///< number of steps that were made
};

/// Options of contact_exponents().
struct ExponentOptions {
  double longest_step = 0.04;  ///< length of the first step, as a fraction of Δφ
  int most_attempts = 5;       ///< largest number of steps; each is half as long as the one before
  MinimiseOptions minimise;    ///< options of the minimisations
};

/// Computes the exponents of the contacts of `packing`, which must be an equilibrium, from one step of a decompression
/// at fixed cell shape. Steps of decreasing length are tried until one succeeds without a change of contacts, so that
/// both states are on the same smooth part of a solution branch. If all steps change contacts, x comes from the
/// shortest one. `contacts` are the contacts of the packing in double-double, as PackingEnergy::contacts() returns
/// them. A step takes less time than one step of the decompression, because it is much shorter.
ContactExponents contact_exponents(const Packing& packing, std::span<const Contact> contacts, PackingEnergy& energy,
                                   const ExponentOptions& options = {});

/// The classes of contacts with these exponents. A contact without exponent is of lower order. A class that needs
/// faces or an edge is given only to contacts that have them (class_constraints()).
std::vector<ContactClass> classes_of(const ContactExponents& exponents, std::span<const Alignment> alignments,
                                     const ExponentBoundaries& boundaries = {});

}  // namespace isojam
