#pragma once

#include <optional>
#include <string_view>

#include "engine/analysis/trough_classes.hpp"
#include "tasks/io/json.hpp"
#include "tasks/io/place.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/measure/shared_parts.hpp"

// Parts of records about the classification of contacts by troughs.

namespace isojam {

/// Quantities of this classification.
inline constexpr Quantity
    Z_ff_trough = {"Z_ff_trough", "/contacts/trough/Z_ff", contact_group, "per particle", "Z_{ff}^{trough}"},
    Z_ef_trough = {"Z_ef_trough", "/contacts/trough/Z_ef", contact_group, "per particle", "Z_{ef}^{trough}"},
    Z_l_trough = {"Z_l_trough", "/contacts/trough/Z_l", contact_group, "per particle", "Z_l^{trough}"},
    C_trough = {"C_trough", "/contacts/trough/C", contact_group, "per particle", "C^{trough}"},
    C_trough_low = {"C_trough_low", "/contacts/trough/C_low", contact_group, "per particle", "C^{trough}_{low}"},
    C_trough_high = {"C_trough_high", "/contacts/trough/C_high", contact_group, "per particle", "C^{trough}_{high}"};

/// The histogram of the alignment angles of a state, and the bins in which cut-offs may lie. These bins are below half
/// of the smallest critical angle over all pairs of shapes.
AngleHistogram histogram_of(const ClassifiedContacts& classified);

/// Writes the histogram, the troughs and the contact numbers to the record of a state.
void put_trough(Json& state, const AngleHistogram& histogram, int particles);

/// JSON of a trough. Its density is per particle: each contact counts for both of its particles.
Json trough_record(const Trough& trough, double particles);

/// The reason why there are no contact numbers by troughs; nullopt if there are.
std::optional<std::string_view> undecided(const TroughCutoffs& cutoffs);

/// Reads the histogram of a state, as put_trough() wrote it, from its place. Throws InputError if it is damaged.
AngleHistogram read_angle_histogram(const JsonPlace& place);
/// JSON pointer to the histogram in the record of a state.
inline constexpr std::string_view angle_bins_pointer = "/contacts/angle_bins";

}  // namespace isojam
