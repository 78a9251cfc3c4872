#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

// The template is instantiated once, in json.cpp.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace isojam {

/// A JSON value. Its keys have the order in which they were inserted, so that the same value always has the same text.
using Json = nlohmann::ordered_json;

/// The text of a value, indented by two spaces and with a line feed at the end. Lists that contain only scalars are on
/// one line. Numbers have enough digits to reproduce them exactly. The value must not contain NaN or infinity.
std::string pretty(const Json& value);

/// The text of a value on one line.
std::string compact(const Json& value);

/// Parses a text. If it is not JSON, throws Json::parse_error, or returns a value that is_discarded() if `throws` is
/// false. Other sources do not call Json::parse(), whose code would then be compiled in each of them.
Json parsed(std::string_view text, bool throws = true);

/// Sets object[key] to a number. JSON has no NaN and no infinity: for these, it sets object[key] to null, and
/// object[key + "_reason"] to "not a number" or "infinite".
void put_number(Json& object, std::string_view key, double value);

/// Sets object[key] to null, and object[key + "_reason"] to the reason.
void put_absent(Json& object, std::string_view key, std::string_view reason);

/// One step of a JSON pointer: "/name", with "~" and "/" escaped according to RFC 6901.
std::string pointer_step(std::string_view name);

}  // namespace isojam
