#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/tables/tables.hpp"

namespace isojam {

// What tables as text, LaTeX and CSV have in common.

using Cells = std::vector<std::string>;

/// The last column of main tables.
inline constexpr std::string_view residual_column = "residual";

std::string joined(const Cells& cells, std::string_view separator);

/// Names of all swept parameters, in order.
std::vector<std::string> parameter_names(const Table& table);
/// What their columns are called: as a manifest calls them, but for that which a column of every table is called too.
std::string parameter_head(const std::string& name);
/// Its value at a sweep point; empty where it was not swept.
std::string parameter_text(const Row& row, const std::string& name);

/// "without replicates flagged crystalline, not_balanced"; empty if the table excludes none.
std::string exclusion_text(const Table& table);

/// A line of a table: a row or one of its series points without the excluded replicates, or, beneath it where there are
/// any, of all.
struct TableLine {
  const Row* row = nullptr;
  std::optional<double> delta_phi;
  const Estimates* estimates = nullptr;
  bool of_all = false;

  /// Replicates that count here.
  int counted() const { return row->replicates - row->failed - (of_all ? 0 : row->excluded); }
};

/// They refer to the table.
std::vector<TableLine> lines_of(const Table& table, View view);

}  // namespace isojam
