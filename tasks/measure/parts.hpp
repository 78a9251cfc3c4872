#pragma once

#include <string>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/measure/measure.hpp"

// The measurements one by one, and what they write. measure() is what others call.

namespace isojam {

Measurement measure_contacts(const JamResult& jam);
/// Z and its parts, C, Q6 and the two fits.
Json contact_record(const ContactAnalysis& analysis);
/// classes_undecided (a fit gave no cut-off), crystalline (Q6 is above crystalline_q6).
std::vector<std::string> contact_flags(const ContactAnalysis& nearest);

}  // namespace isojam
