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

/// "differences from step_fraction = 0.35"; empty if no row is compared.
std::string difference_title(const Table& table);

/// "without replicates flagged crystalline, not_balanced"; empty if the table excludes none.
std::string exclusion_text(const Table& table);

/// What a line is over: the replicates that are not excluded, all of them, or pairs of one of the row and one of its
/// base.
enum class Over : std::uint8_t { kept, all, difference };
template <>
inline constexpr std::array enum_names<Over>{EnumName{Over::kept, "kept"}, EnumName{Over::all, "all"},
                                             EnumName{Over::difference, "difference"}};

/// A line of a table: a row or one of its series points without the excluded replicates; beneath it, where there are
/// any, of all.
struct TableLine {
  const Row* row = nullptr;
  std::optional<double> delta_phi;
  const Estimates* estimates = nullptr;
  Over over = Over::kept;

  /// Replicates that count here, or pairs.
  int counted() const {
    if (over == Over::difference) return row->differences->pairs;
    return row->replicates - row->failed - (over == Over::all ? 0 : row->excluded);
  }
};

/// They refer to the table. Those of differences are left out.
std::vector<TableLine> lines_of(const Table& table, View view);
/// The differences of a row from its base, which it has.
TableLine difference_line(const Row& row);

}  // namespace isojam
