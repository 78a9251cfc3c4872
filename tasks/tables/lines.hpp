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

// Common parts of tables as text, LaTeX and CSV.

using Cells = std::vector<std::string>;

/// The last column of main tables.
inline constexpr std::string_view residual_column = "residual";

std::string joined(const Cells& cells, std::string_view separator);

/// Names of all swept parameters, in order.
std::vector<std::string> parameter_names(const Table& table);
/// Heading of a parameter's column: its name in a manifest, except for a name that another column of every table
/// already has.
std::string parameter_head(const std::string& name);
/// Value of the parameter at a sweep point; empty if it was not swept.
std::string parameter_text(const Row& row, const std::string& name);

/// "differences from step_fraction = 0.35"; empty if no row is compared.
std::string difference_title(const Table& table);

/// "without replicates flagged crystalline, not_balanced"; empty if the table excludes none.
std::string exclusion_text(const Table& table);

/// Basis of a line: replicates that are not excluded, all replicates, or pairs of a replicate of the row and one of its
/// base.
enum class Over : std::uint8_t { kept, all, difference };
template <>
inline constexpr std::array enum_names<Over>{EnumName{Over::kept, "kept"}, EnumName{Over::all, "all"},
                                             EnumName{Over::difference, "difference"}};

/// A line of a table: a row, or one of its series points, without the excluded replicates. If there are any, a second
/// line includes them.
struct TableLine {
  const Row* row = nullptr;
  std::optional<double> delta_phi;
  const Estimates* estimates = nullptr;
  Over over = Over::kept;

  /// Number of replicates or pairs that count in this line.
  int counted() const {
    if (over == Over::difference) return row->differences->pairs;
    return row->replicates - row->failed - (over == Over::all ? 0 : row->excluded);
  }
};

/// The lines refer to the table. Lines of differences are omitted.
std::vector<TableLine> lines_of(const Table& table, View view);
/// The differences of a row from its base. The row must have them.
TableLine difference_line(const Row& row);

}  // namespace isojam
