#pragma once

#include <string>
#include <string_view>

#include "tasks/json/json.hpp"

namespace isojam {

/// Parses a whole document. Throws InputError (with line and column if the text is not JSON) for everything that RFC
/// 8259 forbids, and for cases it leaves open: duplicate keys, numbers beyond double, nesting deeper than 16.
Json parse_json(std::string_view text, const std::string& file);

/// Reads and parses. Throws FileError if the file cannot be read.
Json read_json(const std::string& file);

}  // namespace isojam
