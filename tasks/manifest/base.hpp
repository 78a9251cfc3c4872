#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/io/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

// The base selects the row with which the other rows of the same solid and number of particles are compared. It is a
// JSON object with swept parameters and their values, in canonical form and sorted by name. For a parameter that the
// base does not contain, each row is compared with the base row that has the same value. If the base is empty, no rows
// are compared.

/// Reads the base of a manifest. Throws InputError for an unknown parameter or an invalid value. It does not check
/// whether the parameter is swept, see check_base().
Json read_base(const JsonPlace& place);

/// Throws InputError for the base at `place` if one of its parameters is not swept, or if the sweep does not contain
/// the value of the base.
void check_base(const JsonPlace& place, const Json& base, const std::vector<SweptField>& swept);

/// Parses the text of an option: "none", or "parameter=value" with commas between several. Returns an error text if the
/// text is wrong.
std::optional<std::string> parse_base(const std::string& text, Json& base);

/// The base as text, such as "method = newton, step_fraction = 0.35".
std::string base_text(const Json& base);

}  // namespace isojam
