#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

// Instantiated once, in json.cpp.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace isojam {

/// Keys keep their order of insertion, so that equal values have equal texts.
using Json = nlohmann::ordered_json;

/// The text of a value: indented by two, lists of scalars on one line, a newline at the end. Numbers round-trip
/// exactly. The value must hold no NaN and no infinity.
std::string pretty(const Json& value);

/// The text of a value on one line.
std::string compact(const Json& value);

/// Parses a text. Throws Json::parse_error.
Json parsed(std::string_view text);

/// Sets object[key] to a number. A number that JSON cannot represent becomes null, with the reason at key + "_reason".
void put_number(Json& object, const std::string& key, double value);

/// Sets object[key] to null, with the reason at key + "_reason".
void put_absent(Json& object, const std::string& key, std::string_view reason);

/// The value, or null and the reason.
void put_optional(Json& object, const std::string& key, const std::optional<double>& value, std::string_view reason);

/// "/name", escaped by RFC 6901.
std::string pointer_step(std::string_view name);

}  // namespace isojam
