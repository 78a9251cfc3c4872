#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

// Instantiated once, in json.cpp.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace isojam {

/// A JSON value. Keys keep the order in which they were inserted, so that the same value always has the same text.
using Json = nlohmann::ordered_json;

/// The text of a value, indented by two spaces, with lists of scalars on one line and a line feed at the end. Numbers
/// have enough digits to reproduce them exactly. The value must not contain NaN or infinity.
std::string pretty(const Json& value);

/// The text of a value on one line.
std::string compact(const Json& value);

/// Parses a text. Throws Json::parse_error if it is not JSON.
Json parsed(std::string_view text);

/// Sets object[key] to a number. NaN or infinity, which JSON cannot represent, becomes null, and object[key +
/// "_reason"] states this.
void put_number(Json& object, const std::string& key, double value);

/// Sets object[key] to null, and object[key + "_reason"] to the reason.
void put_absent(Json& object, const std::string& key, std::string_view reason);

/// Calls put_number() if there is a value, and put_absent() otherwise.
void put_optional(Json& object, const std::string& key, const std::optional<double>& value, std::string_view reason);

/// A step of a JSON pointer: "/name", with the characters escaped according to RFC 6901.
std::string pointer_step(std::string_view name);

}  // namespace isojam
