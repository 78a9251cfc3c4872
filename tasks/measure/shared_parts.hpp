#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/measure/measure.hpp"

// Functions shared by the measures.

namespace isojam {

/// Precision for all measures. States are measured with the full precision with which they are stored, also if the
/// minimiser used a lower precision.
inline constexpr Precision state_precision = Precision::double_double;

/// The contacts of a state, their angles and their classes.
struct ClassifiedContacts {
  std::vector<Contact> contacts;
  std::vector<Alignment> alignments;
  ContactAnalysis analysis;
};
ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy);

/// The reason why contacts are not classified; nullopt if they are.
std::optional<std::string_view> undecided(const ContactAnalysis& analysis);

/// JSON with Z and its parts, C, Q6, and the fits from which the classes follow.
Json contact_record(const ContactAnalysis& analysis);
/// Flags: classes_undecided (a fit gave no cut-off), classes_doubtful (a fit gave a cut-off that its curve does not
/// support), crystalline (Q6 is above crystalline_q6).
std::vector<std::string> contact_flags(const ContactAnalysis& nearest);

/// The number x, which must be finite, rounded to this number of significant digits. It keeps long lists short.
double to_digits(double x, int digits);

/// The reason why the cell of a state cannot be relaxed or sheared. nullopt if it can be, that is, if the forces
/// balance and the pressure is positive.
std::optional<std::string_view> not_jammed(const Packing& packing, PackingEnergy& energy);

/// Fits y ∝ Δφ^exponent to the states with Δφ ≤ scaling_window. Writes the exponent, its ci95_half_width and the number
/// of points to the record of a replicate. `y` has one element per state, which is nullopt if y is unknown.
void put_scaling(Json& replicate, const Quantity& exponent, const JamResult& jam,
                 const std::vector<std::optional<double>>& y);
/// largest Δφ of the fits; the default fit window of φ_J. Farther from jamming there is no single power law
inline constexpr double scaling_window = 0.02;

}  // namespace isojam
