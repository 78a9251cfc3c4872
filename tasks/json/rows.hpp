#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/json/json.hpp"

namespace isojam {

/// How a row of a table is written as a line: both hold the same values, numbers to the last bit.
enum class RowFormat : std::uint8_t {
  csv,        ///< RFC 4180 but for lines that end in a line feed; null is an empty field
  json_lines  ///< an object for each row
};

/// A field as CSV has it: quoted where it holds what divides fields and lines.
std::string csv_field(const std::string& text);

/// Names of columns, in order, and their line: empty in JSON lines, whose rows repeat them.
using Columns = std::vector<std::string>;
std::string head_line(RowFormat format, const Columns& columns);

/// The line of a row: a scalar, or null, for each column.
std::string row_line(RowFormat format, const Columns& columns, const std::vector<Json>& values);

}  // namespace isojam
