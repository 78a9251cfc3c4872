#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tasks/tables/aggregate.hpp"

namespace isojam {

inline constexpr std::string_view table_schema = "isojam.tables.v2";

void describe(Fields& field, Row& row);
void describe(Fields& field, Table& table);
/// The content of tables.json.
Json to_json(const Table& table);
/// One row in tables.json.
Json to_json(const Row& row);

/// States that a table describes. nearest: the nearest state of each replicate. series: values at each of
/// series_distances, interpolated between the states of a replicate.
enum class View : std::uint8_t { nearest, series };

/// Choices for the tables as text.
struct TextOptions {
  bool all = true;          ///< print all tables; otherwise the first one, the goal, the differences and `measures`
  std::size_t columns = 0;  ///< largest width in characters; 0: no limit
  /// command that prints all tables. If some tables are not printed, a line names them and this command. If the command
  /// is empty, there is no such line.
  std::string how_to_see_all = {};
  std::vector<Measure> measures = {};  ///< measures whose tables are printed even if `all` is false
};

/// The tables as aligned text, with one table for each group of quantities that have values. If the table excludes
/// flags, the first line states how many replicates have each of these flags. An entry of a table is the mean ± half
/// the width of its 95 % confidence interval. The number n follows in parentheses if only n of the replicates of the
/// line have the value. After the first table there are two more if they have rows: the progress towards the goal, and
/// the paired differences. A line above each table except the first one states what it contains.
std::string to_text(const Table& table, View view = View::nearest, const TextOptions& options = {});

/// The tables as CSV. Each row, or each point of a series, has one to three lines; the column `over` distinguishes
/// them. The line `kept` is for the replicates that are not excluded. The line `all` includes the excluded replicates;
/// it is missing if there are none. The line `difference` has the paired differences from the base row. It is missing
/// if there are none, and for points of a series. Each quantity has columns for mean, low and high end of the 95 %
/// confidence interval, sd, n, and low and high end of the bootstrap interval. A field without a value is empty.
std::string to_csv(const Table& table, View view = View::nearest);
/// The same data as CSV, but each line of to_csv() is divided into one line for each quantity. An additional column
/// contains the name of the quantity.
std::string to_long_csv(const Table& table, View view = View::nearest);

/// The tables as LaTeX: the same as the text, with a tabular environment for each table.
std::string to_latex(const Table& table, View view = View::nearest);

}  // namespace isojam
