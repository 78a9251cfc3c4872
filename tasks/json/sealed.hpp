#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tasks/json/json.hpp"

namespace isojam {

/// Text of a document with a checksum of its own bytes: the second key "checksum" is a 64-bit FNV-1a hash of the text
/// with sixteen zeros in its place. It detects every change of a single byte, and a truncated or mixed file except for
/// a chance of 1 in 2^64.
std::string sealed(const Json& document);

/// Throws InputError if the checksum does not match. Does not parse the document.
void check_seal(std::string_view text, const std::string& file);

/// Parses a sealed text, "checksum" included. Throws InputError if the checksum does not match or the nesting is too
/// deep to use.
Json parse_sealed(std::string_view text, const std::string& file);

/// Reads and parses. Throws FileError if the file is missing or cannot be read now, InputError if it is damaged or not
/// a regular file.
Json read_sealed(const std::string& file);

/// The members of a sealed document before the first that is not a string. Throws as read_sealed does.
std::map<std::string, std::string> read_sealed_head(const std::string& file);

}  // namespace isojam
