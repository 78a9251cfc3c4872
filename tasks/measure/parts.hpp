#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/measure/measure.hpp"

// The measurements one by one, and what they share. measure() is what others call.

namespace isojam {

Measurement measure_contacts(const JamResult& jam);
Measurement measure_order(const JamResult& jam);
Measurement measure_clusters(const JamResult& jam);
Measurement measure_modes(const JamResult& jam, int modes);
Measurement measure_moduli(const JamResult& jam);
Measurement measure_rigidity(const JamResult& jam);

/// The contacts of a state, their angles and their classes.
struct ClassifiedContacts {
  std::vector<Contact> contacts;
  std::vector<Alignment> alignments;
  ContactAnalysis analysis;
};
ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy);

/// Z and its parts, C, Q6 and what decided the classes.
Json contact_record(const ContactAnalysis& analysis);
/// classes_undecided (a fit gave no cut-off), classes_doubtful (one gave a cut-off that its curve does not bear out),
/// crystalline (Q6 is above crystalline_q6).
std::vector<std::string> contact_flags(const ContactAnalysis& nearest);

/// Why classes cannot be told; nullopt if they can.
std::optional<std::string_view> undecided(const ContactAnalysis& analysis);

/// `value`, or null and the reason.
void put_optional(Json& json, const std::string& key, const std::optional<double>& value, std::string_view reason);

/// y ∝ Δφ^exponent over the states within scaling_window of jamming: exponent, ci95_half_width, points. `y` has an
/// entry per state, nullopt where it is not known.
Json scaling_record(const JamResult& jam, const std::vector<std::optional<double>>& y);
inline constexpr double scaling_window = 0.02;  ///< that of φ_J, by default: farther off the powers bend

}  // namespace isojam
