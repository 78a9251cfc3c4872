#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/tables/lines.hpp"

namespace isojam {

/// A table as aligned text that is at most `columns` characters wide; 0 means that there is no limit. The first line is
/// the heading. The first `keys` cells of a line identify it. A table that is too wide is transposed if all its lines
/// then fit beside each other. If they do not fit, the table is divided into blocks of columns, each with the
/// identifying columns. It is transposed before the division if fewer lines are then needed. Numbers are never divided:
/// if the identifying columns and one other column are wider than `columns`, the text is wider too.
std::string fitted(const std::vector<Cells>& lines, std::size_t keys, std::size_t columns);

/// The text with line breaks between words, at most `columns` characters wide; 0 means that there is no limit.
std::string wrapped(std::string_view text, std::size_t columns);

}  // namespace isojam
