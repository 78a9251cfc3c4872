#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Format of the lines of a table. In both formats, numbers have enough digits to reproduce them exactly.
enum class RowFormat : std::uint8_t {
  csv,        ///< CSV according to RFC 4180, except that lines end in a line feed; null is an empty field
  json_lines  ///< one JSON object per line
};

/// The text as a CSV field. It is quoted if it contains a separator.
std::string csv_field(const std::string& text);

/// Names of the columns, in order, and the header line of a table. JSON lines have no header line, because each line
/// contains the names.
using Columns = std::vector<std::string>;
std::string head_line(RowFormat format, const Columns& columns);

/// The line of a row. `values` has a scalar or null for each column.
std::string row_line(RowFormat format, const Columns& columns, const std::vector<Json>& values);

}  // namespace isojam
