#pragma once

#include <string>
#include <string_view>

#include "tasks/json/json.hpp"

namespace isojam {

/// Parses a whole document. Throws InputError (with line and column where the text is not JSON) for anything RFC
/// 8259 does not allow, and for what it leaves open: duplicate keys, numbers beyond double, nesting deeper than 16.
Json parse_json(std::string_view text, const std::string& file);

/// Reads and parses. Throws FileError if the file cannot be read.
Json read_json(const std::string& file);

}  // namespace isojam
