#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Format of a table with one line per row. In both formats, numbers have enough digits to reproduce them exactly.
enum class RowFormat : std::uint8_t {
  csv,        ///< CSV according to RFC 4180, except that a line ends in a line feed only; null is an empty field
  json_lines  ///< each line is a JSON object
};

/// The text as a CSV field. It is in quotation marks if it contains a comma, a quotation mark or a line break.
std::string csv_field(const std::string& text);

/// Names of the columns, in order.
using Columns = std::vector<std::string>;
/// The first line of a table, with the names of the columns. Empty for JSON lines, because each line contains the
/// names.
std::string head_line(RowFormat format, const Columns& columns);

/// The line of one row. `values` has a scalar or null for each column.
std::string row_line(RowFormat format, const Columns& columns, const std::vector<Json>& values);

}  // namespace isojam
