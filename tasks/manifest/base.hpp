#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/json/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

// The row that the others of its solid and size are compared with is told by a base: an object of swept parameters and
// their values, canonical and by name. For a parameter that is left out, every row's own value is taken. Empty: nothing
// is compared.

/// The base of a manifest. Throws InputError for what is no parameter or none of its values; whether it is swept is for
/// check_base to say.
Json read_base(const JsonPlace& place);

/// Refuses a base that stands at `place` where a parameter is not swept, or not over that value.
void check_base(const JsonPlace& place, const Json& base, const std::vector<SweptField>& swept);

/// Takes in "none", or "parameter=value" between commas, as a command line has it, or says what is wrong.
std::optional<std::string> parse_base(const std::string& text, Json& base);

/// "method = newton, step_fraction = 0.35"
std::string base_text(const Json& base);

}  // namespace isojam
