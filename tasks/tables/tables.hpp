#pragma once

#include <cstdint>
#include <string>

#include "tasks/tables/aggregate.hpp"

namespace isojam {

inline constexpr std::string_view table_schema = "isojam.tables.v2";

/// The content of tables.json, and one of its rows.
Json to_json(const Table& table);
Json to_json(const Row& row);

/// States of the replicates to which a table refers. nearest: the states nearest jamming. series: states interpolated
/// at each of series_distances.
enum class View : std::uint8_t { nearest, series };

/// The tables as aligned text, one table for each group of quantities that have values. An entry is the mean ± the half
/// width of the 95 % confidence interval. It is followed by (n) if only n replicates have the value, fewer than are
/// used for the line. The first line of the text states how many replicates are excluded from the means. The goal and
/// the differences from the base row, if there are any, follow the first table.
std::string to_text(const Table& table, View view = View::nearest);

/// The tables as CSV. Each row, or each point of a series, has a line with `kept` in the column `over`. If replicates
/// are excluded, it has a second line with `all`, over all replicates. If there are differences from the base row, it
/// has a line with `difference`. For each quantity that has a value in some line, there are columns for mean, ci95 low
/// and high, sd, n, bootstrap95 low and high. An empty field means that there is no value.
std::string to_csv(const Table& table, View view = View::nearest);
/// The tables as CSV with a separate line for each quantity. An additional column contains the name of the quantity.
std::string to_long_csv(const Table& table, View view = View::nearest);

/// The tables as LaTeX, with a tabular environment for each group of quantities that have values.
std::string to_latex(const Table& table, View view = View::nearest);

}  // namespace isojam
