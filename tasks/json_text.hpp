#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace isojam {

/// Keys keep the order in which they were written, so that equal values have equal texts.
using Json = nlohmann::ordered_json;

/// Parses a whole document. Throws InputError (with line and column where the text is not JSON) for anything RFC
/// 8259 does not allow, and for what it leaves open: duplicate keys, numbers beyond double, nesting deeper than 16.
Json parse_json(std::string_view text, const std::string& file);

/// Reads and parses. Throws FileError if the file cannot be read.
Json read_json(const std::string& file);

/// The file's bytes. Throws FileError if it cannot be read.
std::string read_text(const std::string& file);

/// Indented by two, lists of scalars on one line, ends with a newline. Numbers round-trip exactly.
/// The value must hold no NaN and no infinity.
std::string pretty(const Json& value);

/// FNV-1a of a text, as 16 hexadecimal digits.
std::string hex_hash(std::string_view text);
std::uint64_t hash_of(std::string_view text);

/// Sets object[key] to a number; one that JSON cannot hold becomes null, with the reason at key + "_reason".
void put_number(Json& object, const std::string& key, double value);

/// Sets object[key] to null, with the reason at key + "_reason".
void put_absent(Json& object, const std::string& key, std::string_view reason);

}  // namespace isojam
