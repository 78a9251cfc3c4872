#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/measure/measure.hpp"

// Functions shared by the measures.

namespace isojam {

/// States are measured at the full precision in which they are stored, whatever precision the minimiser needed.
inline constexpr Precision state_precision = Precision::double_double;

/// The contacts of a state, their angles and their classes.
struct ClassifiedContacts {
  std::vector<Contact> contacts;
  std::vector<Alignment> alignments;
  ContactAnalysis analysis;
};
ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy);

/// The reason why contacts cannot be classified; nullopt if they can.
std::optional<std::string_view> undecided(const ContactAnalysis& analysis);

/// Z and its parts, C, Q6 and the basis of the classes.
Json contact_record(const ContactAnalysis& analysis);
/// Flags: classes_undecided (a fit gave no cut-off), classes_doubtful (a fit gave a cut-off that its curve does not
/// support), crystalline (Q6 is above crystalline_q6).
std::vector<std::string> contact_flags(const ContactAnalysis& nearest);

/// x rounded to this many significant digits, which keeps long lists short. x is finite.
double to_digits(double x, int digits);

/// The reason why the cell of a state cannot be relaxed or sheared; nullopt if it can: forces are balanced and the
/// pressure is positive.
std::optional<std::string_view> not_jammed(const Packing& packing, PackingEnergy& energy);

/// Fits y ∝ Δφ^exponent over the states within scaling_window of jamming. Writes the exponent to its place in the
/// record of a replicate, with its ci95_half_width and the points. `y` has an entry per state, nullopt where it is
/// unknown.
void put_scaling(Json& replicate, const Quantity& exponent, const JamResult& jam,
                 const std::vector<std::optional<double>>& y);
inline constexpr double scaling_window = 0.02;  ///< the default fit window of φ_J: farther from jamming there is no
                                                ///< single power law

}  // namespace isojam
