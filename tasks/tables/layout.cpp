// A table is laid out in two steps: what stands in which cell, which is the same for text and LaTeX but for spelling;
// and how cells become lines.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/analysis/alignment/critical_angles.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

using Cells = std::vector<std::string>;

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

/// Of values that would be mostly zeros.
bool small(const Estimate& estimate) {
  return *estimate.mean != 0 && std::abs(*estimate.mean) < 1e-3 && estimate.half_width.value_or(0) < 1e-2;
}

/// With a common power of ten.
std::string small_text(const Estimate& estimate, std::string_view plus_minus, int expected) {
  const double largest = std::max(std::abs(*estimate.mean), estimate.half_width.value_or(0));
  const int power = static_cast<int>(std::floor(std::log10(largest)));
  const double unit = std::pow(10.0, power);
  auto text = fmt::format("({:.2f}", *estimate.mean / unit);
  if (estimate.half_width) text += fmt::format("{}{:.2f}", plus_minus, *estimate.half_width / unit);
  text += fmt::format(")e{:+03d}", power);
  if (estimate.n < expected) text += fmt::format(" ({})", estimate.n);
  return text;
}

std::string estimate_text(const Estimate& estimate, std::string_view plus_minus, int expected) {
  if (!estimate.mean) return "-";
  if (small(estimate)) return small_text(estimate, plus_minus, expected);
  const int decimals = decimals_for(estimate);
  auto text = fmt::format("{:.{}f}", *estimate.mean, decimals);
  if (estimate.half_width) text += fmt::format("{}{:.{}f}", plus_minus, *estimate.half_width, decimals);
  if (estimate.n < expected) text += fmt::format(" ({})", estimate.n);
  return text;
}

std::string residual_text(const Row& row) { return row.residual ? fmt::format("{:.1e}", *row.residual) : "-"; }

/// A line of the table before it is divided into groups: a row, one of its series points, or either without the
/// flagged replicates.
struct Line {
  const Row* row = nullptr;
  std::optional<double> delta_phi;
  const Estimates* estimates = nullptr;
  bool unflagged = false;

  int kept() const { return row->replicates - row->failed - (unflagged ? row->flagged : 0); }
};

std::vector<Line> lines_of(const Table& table, View view) {
  std::vector<Line> lines;
  const auto add = [&](const Row& row, std::optional<double> delta_phi, const auto& place) {
    lines.push_back({&row, delta_phi, &place.estimates, false});
    if (row.flagged > 0) lines.push_back({&row, delta_phi, &place.unflagged, true});
  };
  for (const auto& row : table.rows) {
    if (view == View::nearest) add(row, std::nullopt, row);
    if (view == View::series) {
      for (const auto& point : row.series) add(row, point.delta_phi, point);
    }
  }
  return lines;
}

/// The quantities of a group, by their places in all_quantities().
struct Group {
  std::string_view name;
  std::vector<std::size_t> quantities;
};

std::vector<Group> groups_in(const std::vector<Line>& lines, View view) {
  std::vector<Group> groups;
  const auto all = all_quantities();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (view == View::series && all[i].of == Quantity::Of::replicate) continue;
    const bool any =
        std::any_of(lines.begin(), lines.end(), [&](const Line& line) { return (*line.estimates)[i].n > 0; });
    if (!any && all[i].group != main_group) continue;
    if (groups.empty() || groups.back().name != all[i].group) groups.push_back({all[i].group, {}});
    groups.back().quantities.push_back(i);
  }
  return groups;
}

enum class Format : std::uint8_t { text, latex };

std::string escaped_latex(std::string text) {
  for (auto at = text.find('_'); at != std::string::npos; at = text.find('_', at + 2)) text.insert(at, 1, '\\');
  return text;
}

std::string spelt(const std::string& text, Format format) {
  return format == Format::text ? text : escaped_latex(text);
}

std::string symbol(std::string_view text, std::string_view latex, Format format) {
  return format == Format::text ? std::string(text) : fmt::format("${}$", latex);
}

/// The replicates behind a line are counted in the first table only.
bool counts_replicates(const Group& group, View view) { return group.name == main_group && view == View::nearest; }

Cells head_of(const Group& group, const std::vector<std::string>& parameters, View view, Format format) {
  Cells head{"solid", symbol("N", "N", format)};
  for (const auto& name : parameters) head.push_back(spelt(name, format));
  if (view == View::series) head.push_back(symbol("delta_phi", "\\Delta\\phi", format));
  if (counts_replicates(group, view)) head.insert(head.end(), {"replicates", "failed", "flagged"});
  for (const auto i : group.quantities)
    head.push_back(symbol(all_quantities()[i].name, all_quantities()[i].latex, format));
  if (counts_replicates(group, view)) head.emplace_back("residual");
  return head;
}

Cells cells_of(const Line& line, const Group& group, const std::vector<std::string>& parameters, View view,
               Format format) {
  const Row& row = *line.row;
  const std::string indent = format == Format::text ? "  " : "\\quad ";
  // What a second line has in common with the first is not said again.
  const auto once = [&](const std::string& text) { return line.unflagged ? "" : text; };
  Cells cells{line.unflagged ? indent + "unflagged" : std::string(to_string(row.solid)),
              once(std::to_string(row.particles))};
  for (const auto& name : parameters) cells.push_back(once(spelt(parameter_text(row, name), format)));
  if (view == View::series) cells.push_back(once(fmt::format("{:g}", *line.delta_phi)));
  if (counts_replicates(group, view)) {
    cells.push_back(std::to_string(line.unflagged ? line.kept() : row.replicates));
    cells.push_back(once(std::to_string(row.failed)));
    cells.push_back(once(std::to_string(row.flagged)));
  }
  const std::string_view plus_minus = format == Format::text ? " ± " : " $\\pm$ ";
  for (const auto i : group.quantities) cells.push_back(estimate_text((*line.estimates)[i], plus_minus, line.kept()));
  if (counts_replicates(group, view)) cells.push_back(once(residual_text(row)));
  return cells;
}

/// The paper's Table II, in degrees: a property of the solids.
std::vector<Cells> critical_angle_lines(const Table& table, Format format) {
  const auto head = [&](std::string_view text, std::string_view latex) { return symbol(text, latex, format); };
  std::vector<Cells> lines{{"solid", head("ef vertex-face", "\\theta_{ef}^{vf}"),
                            head("ef edge-edge", "\\theta_{ef}^{ee}"), head("ff vertex-face", "\\theta_{ff}^{vf}"),
                            head("ff edge-edge", "\\theta_{ff}^{ee}"), head("ff edge-face", "\\theta_{ff}^{ef}")}};
  for (const auto& row : table.rows) {
    if (lines.back().front() == to_string(row.solid)) continue;
    const auto angles = critical_angles(platonic(row.solid));
    lines.push_back({std::string(to_string(row.solid))});
    for (const double angle :
         {angles.ef_vertex_face, angles.ef_edge_edge, angles.ff_vertex_face, angles.ff_edge_edge, angles.ff_edge_face})
      lines.back().push_back(fmt::format("{:.2f}", angle * 180 / std::numbers::pi));
  }
  return lines;
}

/// How far the rows came towards the goal; the head alone if they had none.
std::vector<Cells> goal_lines(const Table& table, const std::vector<std::string>& parameters, Format format) {
  std::vector<Cells> lines{{"solid", symbol("N", "N", format)}};
  for (const auto& name : parameters) lines[0].push_back(spelt(name, format));
  lines[0].insert(lines[0].end(), {"quantity", "half width", "aim", "replicates needed", "met"});
  for (const auto& row : table.rows) {
    if (!row.goal) continue;
    const auto& goal = *row.goal;
    Cells cells{std::string(to_string(row.solid)), std::to_string(row.particles)};
    for (const auto& name : parameters) cells.push_back(spelt(parameter_text(row, name), format));
    cells.push_back(spelt(goal.goal.quantity, format));
    cells.push_back(goal.half_width ? fmt::format("{:.3g}", *goal.half_width) : "-");
    cells.push_back(fmt::format("{:.3g}", goal.goal.half_width));
    cells.push_back(goal.needed ? std::to_string(*goal.needed) : "more");
    cells.emplace_back(goal.met ? "yes" : "no");
    lines.push_back(std::move(cells));
  }
  return lines;
}

/// The tables of all groups: head first, then lines.
std::vector<std::pair<std::string_view, std::vector<Cells>>> laid_out(const Table& table, View view, Format format) {
  const auto parameters = parameter_names(table);
  const auto lines = lines_of(table, view);
  std::vector<std::pair<std::string_view, std::vector<Cells>>> tables;
  for (const Group& group : groups_in(lines, view)) {
    std::vector<Cells> cells{head_of(group, parameters, view, format)};
    for (const Line& line : lines) cells.push_back(cells_of(line, group, parameters, view, format));
    tables.emplace_back(group.name, std::move(cells));
    const auto goals = goal_lines(table, parameters, format);
    if (group.name == main_group && view == View::nearest && goals.size() > 1) tables.emplace_back("goal", goals);
    if (group.name == contact_group && view == View::nearest)
      tables.emplace_back("critical angles, degrees", critical_angle_lines(table, format));
  }
  return tables;
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

}  // namespace

std::string to_text(const Table& table, View view) {
  std::string text;
  for (const auto& [group, lines] : laid_out(table, view, Format::text)) {
    if (!text.empty()) text += fmt::format("\n{}\n", group);
    text += aligned(lines);
  }
  return text;
}

std::string to_latex(const Table& table, View view) {
  std::string text;
  for (const auto& [group, lines] : laid_out(table, view, Format::latex)) {
    text += fmt::format("% {}\n\\begin{{tabular}}{{l{}}}\n\\hline\n{} \\\\\n\\hline\n", group,
                        std::string(lines.front().size() - 1, 'r'), joined(lines.front(), " & "));
    for (std::size_t k = 1; k < lines.size(); ++k) text += joined(lines[k], " & ") + " \\\\\n";
    text += "\\hline\n\\end{tabular}\n";
  }
  return text;
}

std::string to_csv(const Table& table, View view) {
  const auto parameters = parameter_names(table);
  Cells head{"solid", "particles"};
  head.insert(head.end(), parameters.begin(), parameters.end());
  head.insert(head.end(), {"replicates", "failed", "flagged"});
  if (view == View::series) head.emplace_back("delta_phi");
  for (const auto& quantity : all_quantities()) {
    for (const auto part : {"mean", "low", "high", "sd", "n", "bootstrap_low", "bootstrap_high"}) {
      head.push_back(fmt::format("{}_{}", quantity.name, part));
    }
  }
  head.emplace_back("residual");
  auto text = joined(head, ",") + '\n';
  for (const Line& line : lines_of(table, view)) {
    if (line.unflagged) continue;
    const Row& row = *line.row;
    Cells cells{std::string(to_string(row.solid)), std::to_string(row.particles)};
    for (const auto& name : parameters) cells.push_back(parameter_text(row, name));
    cells.insert(cells.end(),
                 {std::to_string(row.replicates), std::to_string(row.failed), std::to_string(row.flagged)});
    if (view == View::series) cells.push_back(Json(*line.delta_phi).dump());
    for (const auto& estimate : *line.estimates) append_csv(estimate, cells);
    cells.push_back(row.residual ? Json(*row.residual).dump() : "");
    text += joined(cells, ",") + '\n';
  }
  return text;
}

}  // namespace isojam
