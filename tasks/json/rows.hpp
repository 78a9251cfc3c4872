#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/json/json.hpp"

namespace isojam {

/// Line format of table rows. All formats have the same values, with numbers to the last bit.
enum class RowFormat : std::uint8_t {
  csv,        ///< RFC 4180, except that lines end in a line feed; null is an empty field
  json_lines  ///< one object per row
};

/// A CSV field: quoted if it contains a separator.
std::string csv_field(const std::string& text);

/// Names of columns, in order, and the header line. JSON lines have none, because each row repeats the names.
using Columns = std::vector<std::string>;
std::string head_line(RowFormat format, const Columns& columns);

/// The line of a row: a scalar, or null, for each column.
std::string row_line(RowFormat format, const Columns& columns, const std::vector<Json>& values);

}  // namespace isojam
