#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/json/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

// The base identifies the row with which the other rows of the same solid and size are compared. It is an object of
// swept parameters and their values, canonical and sorted by name. A parameter that is left out takes each row's own
// value. An empty base means no comparison.

/// The base of a manifest. Throws InputError for an unknown parameter or an invalid value. check_base checks that the
/// parameter is swept.
Json read_base(const JsonPlace& place);

/// Refuses a base at `place` if one of its parameters is not swept, or not over that value.
void check_base(const JsonPlace& place, const Json& base, const std::vector<SweptField>& swept);

/// Parses "none" or comma-separated "parameter=value" from a command line; returns an error text if this fails.
std::optional<std::string> parse_base(const std::string& text, Json& base);

/// "method = newton, step_fraction = 0.35"
std::string base_text(const Json& base);

}  // namespace isojam
