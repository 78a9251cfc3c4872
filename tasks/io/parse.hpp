#pragma once

#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// Parses a whole JSON document. Throws InputError for everything that RFC 8259 forbids, with the line and column if
/// the text is not JSON. It also throws for duplicate keys, for numbers outside the range of double, and for objects
/// and lists that are nested deeper than 16.
Json parse_json(std::string_view text, const std::string& file);

/// Reads a file and parses its text with parse_json(). Throws FileError if the file cannot be read.
Json read_json(const std::string& file);

}  // namespace isojam
