#pragma once

#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// Parses a JSON document. Throws InputError if the text violates RFC 8259, with the line and column of the error. Also
/// throws InputError for a duplicate key, for a number outside the range of double, and if objects and lists are nested
/// more than 16 levels deep. `file` is the name of the document in error messages.
Json parse_json(std::string_view text, const std::string& file);

/// Reads a file and passes its text to parse_json(). Throws FileError if the file cannot be read.
Json read_json(const std::string& file);

}  // namespace isojam
