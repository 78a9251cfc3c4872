#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// The text of a document with a checksum. The checksum is the value of the second key, "checksum". It is the 64-bit
/// FNV-1a hash of the text, computed with sixteen zeros in place of the checksum. Every change of a single byte is
/// detected. A truncated file, or a mixture of two files, remains undetected with a probability of 2^-64.
std::string sealed(const Json& document);

/// Throws InputError unless the text has a checksum that matches it. Does not parse the document.
void check_seal(std::string_view text, const std::string& file);

/// Parses a text with a checksum. The returned document contains the key "checksum". Throws InputError if the checksum
/// does not match the text, or if objects and lists are nested more than 32 levels deep.
Json parse_sealed(std::string_view text, const std::string& file);

/// Parses a text without a check of its checksum. Throws InputError if it is not JSON or nested too deeply.
Json parsed_document(std::string_view text, const std::string& file);

/// Reads the text of a file that isojam wrote, without checking it. Throws FileError if the file is missing or cannot
/// be read at the moment. Throws InputError if it is not a regular file.
std::string read_result(const std::string& file);

/// Reads a file and passes its text to parse_sealed(). Throws FileError if the file is missing or cannot be read at the
/// moment. Throws InputError if it is damaged or not a regular file.
Json read_sealed(const std::string& file);

/// Checks the checksum of a file, and returns only its first members: all members before the first one that is not a
/// string. Throws the same exceptions as read_sealed().
std::map<std::string, std::string> read_sealed_head(const std::string& file);

}  // namespace isojam
