#include "tasks/tables/lines.hpp"

#include <fmt/format.h>

#include <set>

#include "tasks/manifest/base.hpp"

namespace isojam {

std::string joined(const Cells& cells, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) text += separator;
    text += cells[i];
  }
  return text;
}

std::vector<std::string> parameter_names(const Table& table) {
  std::set<std::string> names;
  for (const auto& row : table.rows) {
    for (const auto& item : row.parameters.items()) names.insert(item.key());
  }
  return {names.begin(), names.end()};
}

std::string parameter_head(const std::string& name) { return name == residual_column ? "minimiser." + name : name; }

std::string parameter_text(const Row& row, const std::string& name) {
  if (!row.parameters.contains(name)) return "";
  const auto& value = row.parameters.at(name);
  return value.is_string() ? value.get<std::string>() : compact(value);
}

std::string exclusion_text(const Table& table) {
  Cells counts;
  for (const auto flag : table.exclude) {
    const auto found = table.excluded.find(flag);
    counts.push_back(fmt::format("{} ({})", to_string(flag), found == table.excluded.end() ? 0 : found->second));
  }
  return counts.empty() ? "" : "excluded from means: " + joined(counts, ", ");
}

std::string nearest_only_text(const Table& table) {
  Cells counts;
  for (const auto& [measure, replicates] : table.nearest_only)
    counts.push_back(fmt::format("{} ({})", to_string(measure), replicates));
  return counts.empty() ? "" : "measured only for the state nearest jamming (replicates): " + joined(counts, ", ");
}

std::string difference_title(const Table& table) {
  return table.base.empty() ? "" : "differences from " + base_text(table.base);
}

TableLine difference_line(const Row& row) {
  return {&row, std::nullopt, &row.differences->estimates, Over::difference};
}

std::vector<TableLine> lines_of(const Table& table, View view) {
  std::vector<TableLine> lines;
  const auto add = [&](const Row& row, std::optional<double> delta_phi, const auto& place) {
    lines.push_back({&row, delta_phi, &place.estimates, Over::kept, place.trough ? &*place.trough : nullptr});
    if (row.excluded > 0) lines.push_back({&row, delta_phi, &place.all, Over::all});
  };
  for (const auto& row : table.rows) {
    if (view == View::nearest) add(row, std::nullopt, row);
    if (view == View::series) {
      for (const auto& point : row.series) add(row, point.delta_phi, point);
    }
  }
  return lines;
}

}  // namespace isojam
