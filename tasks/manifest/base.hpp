#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/io/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

// The base of a manifest as a JSON object: swept parameters with their values, sorted by name. A row of a table is
// compared with another row, its base row. For a parameter in the base, the base row has the value of the base. For
// everything else (solid, number of particles, other parameters) it has the value of the compared row. If the base is
// empty, no rows are compared.

/// Reads the base of a manifest. Throws InputError if the object is empty, if a parameter is unknown, or if a value is
/// not allowed. check_base() checks whether the parameters are swept.
Json read_base(const JsonPlace& place);

/// Checks that each parameter in `base` is one of the `swept` parameters, and that its value is one of the swept
/// values. Otherwise throws InputError. `place` is the location of the base, for error messages.
void check_base(const JsonPlace& place, const Json& base, const SweptValues& swept);

/// Parses the value of the option --base: "none", or one or more "parameter=value" separated by commas. "none" gives an
/// empty base. Returns an error message if the text is invalid; otherwise sets `base` and returns nullopt.
std::optional<std::string> parse_base(const std::string& text, Json& base);

/// The base as text, such as "method = newton, step_fraction = 0.35".
std::string base_text(const Json& base);

}  // namespace isojam
