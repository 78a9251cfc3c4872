#pragma once

#include <cstdint>
#include <string>

#include "tasks/tables/aggregate.hpp"

namespace isojam {

inline constexpr std::string_view table_schema = "isojam.tables.v2";

/// tables.json, and one of its rows.
Json to_json(const Table& table);
Json to_json(const Row& row);

/// States of the replicates: those nearest jamming, or those at each of series_distances.
enum class View : std::uint8_t { nearest, series };

/// The tables as aligned text, one for each group of columns with values. Cells are mean ± half width of the 95 %
/// confidence interval, with (n) if fewer replicates have the value than count. A line above each table lists the
/// exclusions. The goal and, with a base, the differences of rows from it follow the first table.
std::string to_text(const Table& table, View view = View::nearest);

/// One line per row or point of a series, one of all replicates where some are excluded, and of a row one of its
/// differences from the base: `over` says "kept", "all" or "difference". For each quantity that some line has: mean,
/// ci95 low and high, sd, n, bootstrap95 low and high. Empty: no value.
std::string to_csv(const Table& table, View view = View::nearest);
/// The same with a line for each of these quantities, named in a column of its own.
std::string to_long_csv(const Table& table, View view = View::nearest);

/// A tabular environment for each group of columns that has values.
std::string to_latex(const Table& table, View view = View::nearest);

}  // namespace isojam
