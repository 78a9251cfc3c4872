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

// Common parts of tables in the formats text, LaTeX and CSV.

using Cells = std::vector<std::string>;

/// Name of the last column of main tables.
inline constexpr std::string_view residual_column = "residual";

std::string joined(const Cells& cells, std::string_view separator);

/// Names of all swept parameters of a table, in order.
std::vector<std::string> parameter_names(const Table& table);
/// Heading of the column of a parameter. It is the name of the parameter in manifests, except if another column of
/// every table already has this name.
std::string parameter_head(const std::string& name);
/// Value of a parameter at a sweep point, as text. Empty if the parameter was not swept.
std::string parameter_text(const Row& row, const std::string& name);

/// Title of the table of differences, such as "differences from step_fraction = 0.35". Empty if no row is compared.
std::string difference_title(const Table& table);

/// "excluded from means: crystalline (2), not_balanced (0)", with numbers of replicates; empty if the table excludes no
/// flag. It precedes the first table.
std::string exclusion_text(const Table& table);

/// The replicates over which the estimates of a line are taken. kept: replicates that are not excluded. all: all
/// replicates. difference: pairs of a replicate of the row and a replicate of its base row.
enum class Over : std::uint8_t { kept, all, difference };
template <>
inline constexpr std::array enum_names<Over>{EnumName{Over::kept, "kept"}, EnumName{Over::all, "all"},
                                             EnumName{Over::difference, "difference"}};

/// A line of a table: a row, or one point of the series of a row. If replicates are excluded, there are two lines, one
/// without and one with these replicates.
struct TableLine {
  const Row* row = nullptr;
  std::optional<double> delta_phi;
  const Estimates* estimates = nullptr;
  Over over = Over::kept;

  /// Number of replicates or pairs that are used for the estimates of this line.
  int counted() const {
    if (over == Over::difference) return row->differences->pairs;
    return row->replicates - row->failed - (over == Over::all ? 0 : row->excluded);
  }
};

/// All lines of a table, except the lines of differences. They refer to the table, which must outlive them.
std::vector<TableLine> lines_of(const Table& table, View view);
/// The line with the differences of a row from its base row. The row must have differences.
TableLine difference_line(const Row& row);

}  // namespace isojam
