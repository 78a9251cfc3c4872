#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/measure/measure.hpp"

// What the measurements share.

namespace isojam {

/// States are measured in all their digits, whatever was enough to find them: what is stored of them is that.
inline constexpr Precision state_precision = Precision::double_double;

/// The contacts of a state, their angles and their classes.
struct ClassifiedContacts {
  std::vector<Contact> contacts;
  std::vector<Alignment> alignments;
  ContactAnalysis analysis;
};
ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy);

/// Why classes cannot be told; nullopt if they can.
std::optional<std::string_view> undecided(const ContactAnalysis& analysis);

/// Z and its parts, C, Q6 and what decided the classes.
Json contact_record(const ContactAnalysis& analysis);
/// classes_undecided (a fit gave no cut-off), classes_doubtful (one gave a cut-off that its curve does not bear out),
/// crystalline (Q6 is above crystalline_q6).
std::vector<std::string> contact_flags(const ContactAnalysis& nearest);

/// x rounded to some significant digits: long lists need no more. x is finite.
double to_digits(double x, int digits);

/// Why a state cannot be freed or sheared; nullopt if it can: forces balance, and it bears a pressure.
std::optional<std::string_view> not_jammed(const Packing& packing, PackingEnergy& energy);

/// Writes the law y ∝ Δφ^exponent over the states within scaling_window of jamming where `exponent` stands in the
/// record of a replicate, and beside it its ci95_half_width and the points. `y` has an entry per state, nullopt where
/// it is not known.
void put_scaling(Json& replicate, const Quantity& exponent, const JamResult& jam,
                 const std::vector<std::optional<double>>& y);
inline constexpr double scaling_window = 0.02;  ///< that of φ_J, by default: farther off the powers bend

}  // namespace isojam
