#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// The text of a document with a checksum. The checksum is the value of the second key, "checksum": the 64-bit FNV-1a
/// hash of the text, computed with sixteen zeros in place of the checksum. It detects every change of a single byte. It
/// does not detect a truncated file, or a mixture of two files, with a probability of 1 in 2^64.
std::string sealed(const Json& document);

/// Throws InputError if the checksum does not match the text. Does not parse the document.
void check_seal(std::string_view text, const std::string& file);

/// Parses a text with a checksum. The result includes the key "checksum". Throws InputError if the checksum does not
/// match the text, or if objects and lists are nested too deeply.
Json parse_sealed(std::string_view text, const std::string& file);

/// Reads a file and parses it with parse_sealed(). Throws FileError if the file is missing or cannot be read at the
/// moment, and InputError if it is damaged or not a regular file.
Json read_sealed(const std::string& file);

/// Reads only the beginning of a file with a checksum: the members before the first one that is not a string. Throws
/// the same exceptions as read_sealed().
std::map<std::string, std::string> read_sealed_head(const std::string& file);

}  // namespace isojam
