#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {

// Common parts of the tables as text, LaTeX and CSV.

using Cells = std::vector<std::string>;

/// Heading of the column with the residual.
inline constexpr std::string_view residual_column = "residual";

std::string joined(const Cells& cells, std::string_view separator);

/// Names of the swept parameters of all rows, sorted.
std::vector<std::string> parameter_names(const Table& table);
/// Heading of the column of a parameter: the name of the parameter. The parameter `residual` has the heading
/// "minimiser.residual" instead, because another column is called residual.
std::string parameter_head(const std::string& name);
/// Value of a parameter in a row, as text. Empty if the parameter was not swept.
std::string parameter_text(const Row& row, const std::string& name);

/// Title of the table of paired differences, such as "differences from step_fraction = 0.35". Empty if the table has no
/// base.
std::string difference_title(const Table& table);

/// "excluded from means: crystalline (2), not_balanced (0)", with the numbers of replicates. Empty if the table
/// excludes no flag.
std::string exclusion_text(const Table& table);
/// "measured only for the state nearest jamming (replicates): modes (8)". Empty if all states of all replicates were
/// measured.
std::string nearest_only_text(const Table& table);

/// The replicates that are used for the estimates of a line. kept: all that neither failed nor are excluded. all: all
/// that did not fail. difference: pairs of a replicate of the row and a replicate of its base row.
enum class Over : std::uint8_t { kept, all, difference };
template <>
inline constexpr std::array enum_names<Over>{EnumName{Over::kept, "kept"}, EnumName{Over::all, "all"},
                                             EnumName{Over::difference, "difference"}};

/// A line of a table: a row, or one point of the series of a row. If replicates of the row are excluded, there is a
/// second line that includes them.
struct TableLine {
  const Row* row = nullptr;
  /// distance to jamming of a point of the series; nullopt for a row
  std::optional<double> delta_phi;
  const Estimates* estimates = nullptr;
  Over over = Over::kept;
  /// troughs of all replicates of a line `kept` together; null if there are none
  const PooledTrough* trough = nullptr;

  /// Number of replicates or pairs that are used for the estimates of this line.
  int counted() const {
    if (over == Over::difference) return row->differences->pairs;
    return row->replicates - row->failed - (over == Over::all ? 0 : row->excluded);
  }
};

/// All lines of a table without the lines of paired differences. The table must outlive them.
std::vector<TableLine> lines_of(const Table& table, View view);
/// The line with the paired differences of a row. The row must have differences.
TableLine difference_line(const Row& row);

}  // namespace isojam
