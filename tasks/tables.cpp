#include "tasks/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace isojam {
namespace {

using Cells = std::vector<std::string>;

Json to_json(const Estimate& estimate) {
  Json json;
  const auto put = [&](const std::string& key, const std::optional<double>& value) {
    json[key] = value ? Json(*value) : Json(nullptr);
  };
  const auto put_interval = [&](const std::string& key, const std::optional<Interval>& interval) {
    json[key] = interval ? Json{interval->low, interval->high} : Json(nullptr);
  };
  put("mean", estimate.mean);
  put_interval("ci95", estimate.ci95);
  put("half_width", estimate.half_width);
  put("sd", estimate.sd);
  json["n"] = estimate.n;
  put_interval("bootstrap95", estimate.bootstrap95);
  if (estimate.n == 0) json["reason"] = "no replicate has this value";
  if (estimate.n == 1) json["reason"] = "one replicate has no spread";
  return json;
}

/// Names of all swept parameters, in order.
std::vector<std::string> parameter_names(const Table& table) {
  std::set<std::string> names;
  for (const auto& row : table.rows) {
    for (const auto& item : row.parameters.items()) names.insert(item.key());
  }
  return {names.begin(), names.end()};
}

std::string parameter_text(const Row& row, const std::string& name) {
  if (!row.parameters.contains(name)) return "";
  const auto& value = row.parameters.at(name);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

constexpr int digits_without_interval = 4;

/// Decimals that leave the half width two significant digits.
int decimals_for(const Estimate& estimate) {
  if (!estimate.half_width || *estimate.half_width <= 0) return digits_without_interval;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(*estimate.half_width))), 0, 12);
}

std::string estimate_text(const Estimate& estimate, std::string_view plus_minus, int expected) {
  if (!estimate.mean) return "-";
  const int decimals = decimals_for(estimate);
  auto text = fmt::format("{:.{}f}", *estimate.mean, decimals);
  if (estimate.half_width) text += fmt::format("{}{:.{}f}", plus_minus, *estimate.half_width, decimals);
  if (estimate.n < expected) text += fmt::format(" ({})", estimate.n);
  return text;
}

std::string residual_text(const Row& row) { return row.residual ? fmt::format("{:.1e}", *row.residual) : "-"; }

Cells row_cells(const Row& row, const std::vector<std::string>& parameters, std::string_view plus_minus) {
  Cells cells{std::string(to_string(row.solid)), std::to_string(row.particles)};
  for (const auto& name : parameters) cells.push_back(parameter_text(row, name));
  cells.push_back(std::to_string(row.replicates));
  cells.push_back(std::to_string(row.failed));
  cells.push_back(std::to_string(row.flagged));
  for (const auto& estimate : row.estimates) {
    cells.push_back(estimate_text(estimate, plus_minus, row.replicates - row.failed));
  }
  cells.push_back(residual_text(row));
  return cells;
}

/// The second line of a row with flagged replicates: its estimates without them.
Cells unflagged_cells(const Row& row, const std::vector<std::string>& parameters, std::string_view plus_minus) {
  const int kept = row.replicates - row.failed - row.flagged;
  Cells cells{"  unflagged", ""};
  cells.resize(cells.size() + parameters.size());
  cells.push_back(std::to_string(kept));
  cells.resize(cells.size() + 2);
  for (const auto& estimate : row.unflagged) cells.push_back(estimate_text(estimate, plus_minus, kept));
  cells.emplace_back();
  return cells;
}

/// Characters of a UTF-8 text.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string aligned(const std::vector<Cells>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width(line[i]));
  }
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string padding(widths[i] - width(line[i]), ' ');
      // Names to the left, numbers to the right.
      text += i == 0 ? fmt::format("{}{}", line[i], padding) : fmt::format("   {}{}", padding, line[i]);
    }
    text += '\n';
  }
  return text;
}

std::string joined(const Cells& cells, std::string_view separator) {
  std::string text;
  for (const auto& cell : cells) {
    if (!text.empty()) text += separator;
    text += cell;
  }
  return text;
}

void append_csv(const Estimate& estimate, Cells& cells) {
  const auto number = [&](const std::optional<double>& x) { cells.push_back(x ? Json(*x).dump() : ""); };
  const auto interval = [&](const std::optional<Interval>& x) {
    number(x ? std::optional(x->low) : std::nullopt);
    number(x ? std::optional(x->high) : std::nullopt);
  };
  number(estimate.mean);
  interval(estimate.ci95);
  number(estimate.sd);
  cells.push_back(std::to_string(estimate.n));
  interval(estimate.bootstrap95);
}

std::string escaped_latex(std::string text) {
  for (auto at = text.find('_'); at != std::string::npos; at = text.find('_', at + 2)) text.insert(at, 1, '\\');
  return text;
}

}  // namespace

Json to_json(const Table& table) {
  Json json;
  json["schema"] = table_schema;
  json["rows"] = Json::array();
  for (const auto& row : table.rows) {
    Json entry;
    entry["solid"] = to_string(row.solid);
    entry["particles"] = row.particles;
    entry["parameters"] = row.parameters;
    entry["replicates"] = row.replicates;
    entry["failed"] = row.failed;
    entry["flagged"] = row.flagged;
    for (std::size_t i = 0; i < columns.size(); ++i) entry[std::string(columns[i].name)] = to_json(row.estimates[i]);
    if (row.flagged > 0) {
      auto& unflagged = entry["unflagged"];
      for (std::size_t i = 0; i < columns.size(); ++i) {
        unflagged[std::string(columns[i].name)] = to_json(row.unflagged[i]);
      }
    }
    entry["residual"] = row.residual ? Json(*row.residual) : Json(nullptr);
    json["rows"].push_back(std::move(entry));
  }
  return json;
}

std::string to_text(const Table& table) {
  const auto parameters = parameter_names(table);
  Cells head{"solid", "N"};
  head.insert(head.end(), parameters.begin(), parameters.end());
  head.insert(head.end(), {"replicates", "failed", "flagged"});
  for (const auto& column : columns) head.emplace_back(column.name);
  head.emplace_back("residual");
  std::vector<Cells> lines{head};
  for (const auto& row : table.rows) {
    lines.push_back(row_cells(row, parameters, " ± "));
    if (row.flagged > 0) lines.push_back(unflagged_cells(row, parameters, " ± "));
  }
  return aligned(lines);
}

std::string to_csv(const Table& table) {
  const auto parameters = parameter_names(table);
  Cells head{"solid", "particles"};
  head.insert(head.end(), parameters.begin(), parameters.end());
  head.insert(head.end(), {"replicates", "failed", "flagged"});
  for (const auto& column : columns) {
    for (const auto part : {"mean", "low", "high", "sd", "n", "bootstrap_low", "bootstrap_high"}) {
      head.push_back(fmt::format("{}_{}", column.name, part));
    }
  }
  head.emplace_back("residual");
  auto text = joined(head, ",") + '\n';
  for (const auto& row : table.rows) {
    Cells cells{std::string(to_string(row.solid)), std::to_string(row.particles)};
    for (const auto& name : parameters) cells.push_back(parameter_text(row, name));
    cells.insert(cells.end(),
                 {std::to_string(row.replicates), std::to_string(row.failed), std::to_string(row.flagged)});
    for (const auto& estimate : row.estimates) append_csv(estimate, cells);
    cells.push_back(row.residual ? Json(*row.residual).dump() : "");
    text += joined(cells, ",") + '\n';
  }
  return text;
}

std::string to_latex(const Table& table) {
  const auto parameters = parameter_names(table);
  Cells head{"solid", "$N$"};
  for (const auto& name : parameters) head.push_back(escaped_latex(name));
  head.insert(head.end(), {"replicates", "failed", "flagged"});
  for (const auto& column : columns) head.push_back(fmt::format("${}$", column.latex));
  head.emplace_back("residual");
  auto text = fmt::format("\\begin{{tabular}}{{l{}}}\n\\hline\n{} \\\\\n\\hline\n", std::string(head.size() - 1, 'r'),
                          joined(head, " & "));
  for (const auto& row : table.rows) {
    auto cells = row_cells(row, parameters, " $\\pm$ ");
    for (auto& cell : cells) cell = escaped_latex(cell);
    text += joined(cells, " & ") + " \\\\\n";
  }
  return text + "\\hline\n\\end{tabular}\n";
}

}  // namespace isojam
