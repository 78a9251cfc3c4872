#pragma once

#include <cstdint>
#include <string>

#include "tasks/tables/statistics.hpp"

namespace isojam {

enum class Format : std::uint8_t { text, latex };

/// Text of an estimate in a table, such as "0.6812 ± 0.0037" or, for a proportion, "0.17 [0.05, 0.45]". The half width
/// has two significant digits, unless the mean would then have more than six. If fewer than `expected` values were
/// averaged, their number follows. docs/results.md lists all forms.
std::string estimate_text(const Estimate& estimate, Format format, int expected);

}  // namespace isojam
