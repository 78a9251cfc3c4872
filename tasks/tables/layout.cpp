// Tables are made in two steps. The first step fills the cells. Except for spelling, they are the same for text and
// LaTeX. The second step turns the cells into lines.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/tables/estimate_text.hpp"
#include "tasks/tables/fitted.hpp"
#include "tasks/tables/lines.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

std::string residual_text(const Row& row) { return row.residual ? fmt::format("{:.1e}", *row.residual) : "-"; }

/// The quantities of one table, as indices in all_quantities().
struct ColumnGroup {
  QuantityGroup is;
  std::vector<std::size_t> quantities;
};

std::vector<ColumnGroup> groups_in(const std::vector<TableLine>& lines, View view) {
  std::vector<ColumnGroup> groups;
  const auto all = all_quantities();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (view == View::series && all[i].of == Quantity::Of::replicate) continue;
    const bool any =
        std::any_of(lines.begin(), lines.end(), [&](const TableLine& line) { return (*line.estimates)[i].n > 0; });
    if (!any && !is_always_listed(all[i])) continue;
    if (groups.empty() || groups.back().is != all[i].group) groups.push_back({all[i].group, {}});
    groups.back().quantities.push_back(i);
  }
  return groups;
}

std::string_view in_latex(const char& c) {
  switch (c) {
    case '#': return "\\#";
    case '$': return "\\$";
    case '%': return "\\%";
    case '&': return "\\&";
    case '_': return "\\_";
    case '{': return "\\{";
    case '}': return "\\}";
    case '~': return "\\textasciitilde{}";
    case '^': return "\\textasciicircum{}";
    case '\\': return "\\textbackslash{}";
    default: return {&c, 1};
  }
}

/// Text of a cell: control characters are replaced, and special characters of LaTeX are escaped.
std::string spelt(const std::string& text, Format format) {
  std::string cell;
  for (const char& c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    cell += control ? "?" : format == Format::latex ? in_latex(c) : std::string_view(&c, 1);
  }
  return cell;
}

std::string symbol(std::string_view text, std::string_view latex, Format format) {
  return format == Format::text ? std::string(text) : fmt::format("${}$", latex);
}

/// True for the main table, which alone has the columns with the numbers of replicates.
bool counts_replicates(const ColumnGroup& group, View view) { return group.is == main_group && view == View::nearest; }

Cells head_of(const ColumnGroup& group, const std::vector<std::string>& parameters, View view, Format format) {
  Cells head{"solid", symbol("N", "N", format)};
  for (const auto& name : parameters) head.push_back(spelt(parameter_head(name), format));
  if (view == View::series) head.push_back(symbol("delta_phi", "\\Delta\\phi", format));
  if (counts_replicates(group, view)) head.insert(head.end(), {"replicates", "failed", "flagged", "excluded"});
  for (const auto i : group.quantities)
    head.push_back(symbol(all_quantities()[i].name, all_quantities()[i].latex, format));
  if (counts_replicates(group, view)) head.emplace_back(residual_column);
  return head;
}

Cells cells_of(const TableLine& line, const ColumnGroup& group, const std::vector<std::string>& parameters, View view,
               Format format) {
  const Row& row = *line.row;
  const std::string indent = format == Format::text ? "  " : "\\quad ";
  // The second line of a row, `all`, omits the cells that would be the same as in the first line.
  const bool of_all = line.over == Over::all;
  const auto once = [&](const std::string& text) { return of_all ? "" : text; };
  Cells cells{of_all ? indent + "all" : spelt(std::string(to_string(row.solid)), format),
              once(std::to_string(row.particles))};
  for (const auto& name : parameters) cells.push_back(once(spelt(parameter_text(row, name), format)));
  if (view == View::series) cells.push_back(once(fmt::format("{:g}", *line.delta_phi)));
  if (counts_replicates(group, view)) {
    for (const int count : {row.replicates, row.failed, row.flagged, row.excluded})
      cells.push_back(once(std::to_string(count)));
  }
  for (const auto i : group.quantities) cells.push_back(estimate_text((*line.estimates)[i], format, line.counted()));
  if (counts_replicates(group, view)) cells.push_back(once(residual_text(row)));
  return cells;
}

/// Lines of the table of critical angles (Table II of the paper), in degrees. They depend only on the solid.
std::vector<Cells> critical_angle_lines(const Table& table, Format format) {
  const auto head = [&](std::string_view text, std::string_view latex) { return symbol(text, latex, format); };
  std::vector<Cells> lines{{"solid", head("ef vertex-face", "\\theta_{ef}^{vf}"),
                            head("ef edge-edge", "\\theta_{ef}^{ee}"), head("ff vertex-face", "\\theta_{ff}^{vf}"),
                            head("ff edge-edge", "\\theta_{ff}^{ee}"), head("ff edge-face", "\\theta_{ff}^{ef}")}};
  for (const auto& row : table.rows) {
    const auto name = spelt(std::string(to_string(row.solid)), format);
    if (lines.back().front() == name) continue;
    const auto angles = critical_angles(row.solid);
    lines.push_back({name});
    for (const double angle :
         {angles.ef_vertex_face, angles.ef_edge_edge, angles.ff_vertex_face, angles.ff_edge_edge, angles.ff_edge_face})
      lines.back().push_back(fmt::format("{:.2f}", angle * 180 / std::numbers::pi));
  }
  return lines;
}

/// Headings of the columns that identify a sweep point.
Cells point_head(const std::vector<std::string>& parameters, Format format) {
  Cells head{"solid", symbol("N", "N", format)};
  for (const auto& name : parameters) head.push_back(spelt(parameter_head(name), format));
  return head;
}

Cells point_cells(const Row& row, const std::vector<std::string>& parameters, Format format) {
  Cells cells{spelt(std::string(to_string(row.solid)), format), std::to_string(row.particles)};
  for (const auto& name : parameters) cells.push_back(spelt(parameter_text(row, name), format));
  return cells;
}

/// Quantities whose differences are printed. JSON and CSV contain the differences of all quantities.
constexpr std::array compared_quantities{"phi_j", "Z", "Z_ff", "C"};

/// Lines with the paired differences of the rows from their base rows. Only the heading if no row has a base row.
std::vector<Cells> difference_lines(const Table& table, const std::vector<std::string>& parameters, Format format) {
  std::vector<Cells> lines{point_head(parameters, format)};
  lines[0].emplace_back("pairs");
  for (const auto* name : compared_quantities) lines[0].push_back(symbol(name, quantity(name).latex, format));
  for (const auto& row : table.rows) {
    if (!row.differences) continue;
    auto cells = point_cells(row, parameters, format);
    cells.push_back(std::to_string(row.differences->pairs));
    for (const auto* name : compared_quantities)
      cells.push_back(estimate_text(row.differences->estimates[*quantity_index(name)], format, row.differences->pairs));
    lines.push_back(std::move(cells));
  }
  return lines;
}

/// Lines with the progress of the rows towards the goal of the stopping rule. Only the heading if there is no goal.
std::vector<Cells> goal_lines(const Table& table, const std::vector<std::string>& parameters, Format format) {
  std::vector<Cells> lines{point_head(parameters, format)};
  lines[0].insert(lines[0].end(), {"quantity", "half width", "goal", "first", "replicates used", "met"});
  for (const auto& row : table.rows) {
    if (!row.goal) continue;
    const auto& goal = *row.goal;
    auto cells = point_cells(row, parameters, format);
    cells.push_back(spelt(goal.goal.quantity, format));
    cells.push_back(goal.half_width ? fmt::format("{:.3g}", *goal.half_width) : "-");
    cells.push_back(fmt::format("{:.3g}", goal.goal.half_width));
    cells.push_back(goal.first.empty() ? "-" : std::to_string(goal.first.size()));
    cells.push_back(goal.needed ? std::to_string(*goal.needed) : "more needed");
    cells.emplace_back(goal.met ? "yes" : "no");
    lines.push_back(std::move(cells));
  }
  return lines;
}

constexpr std::string_view goal_meaning =
    "Half width of the 95 % confidence interval at the last check, from the standard deviation of the first "
    "replicates. "
    "The interval of a proportion is Wilson's.";
constexpr std::string_view difference_meaning =
    "Mean differences between replicates with the same initial configuration ± 95 % confidence interval.";
constexpr std::string_view trough_meaning =
    "log10 of the lower edge, the cut-off and the upper edge of each trough (rad); contact numbers with these "
    "cut-offs.";
constexpr std::string_view angle_meaning =
    "Largest angles, in degrees, that the shapes allow for each kind of contact.";

struct LaidOut {
  std::string_view name, meaning;
  std::vector<Cells> lines;  ///< the first line is the heading
  std::size_t keys;          ///< number of columns that identify a line
  bool requested = false;    ///< true for the tables that the manifest or the command line requests
};

/// Logarithms of the lower edge of a trough, of the cut-off, and of the upper edge.
Cells trough_cells(const Trough& trough) {
  if (trough.verdict != TroughVerdict::found) return {"-", "undecided", "-"};
  Cells cells;
  for (const int bin : {trough.low, trough.cutoff, trough.high})
    cells.push_back(fmt::format("{:.2f}", nearest::log10(angle_bin_edge(bin))));
  return cells;
}

/// The table of the troughs of all replicates together; the heading alone if there are none.
std::vector<Cells> pooled_lines(const std::vector<TableLine>& lines, const std::vector<std::string>& parameters,
                                Format format) {
  std::vector<Cells> cells{point_head(parameters, format)};
  const auto append = [](Cells& line, const Cells& more) { line.insert(line.end(), more.begin(), more.end()); };
  const bool of_series = !lines.empty() && lines.front().delta_phi;
  if (of_series) cells[0].push_back(symbol("delta_phi", "\\Delta\\phi", format));
  append(cells[0], {"replicates", "ff low", symbol("log ff", "\\log_{10}\\theta_{ff}", format), "ff high", "ef low",
                    symbol("log ef", "\\log_{10}\\theta_{ef}", format), "ef high"});
  for (const auto name : {"Z_ff", "Z_ef", "Z_l", "C", "C_low", "C_high"}) cells[0].push_back(spelt(name, format));
  for (const TableLine& line : lines) {
    if (!line.trough) continue;
    auto next = point_cells(*line.row, parameters, format);
    if (of_series) next.push_back(fmt::format("{:g}", *line.delta_phi));
    next.push_back(std::to_string(line.trough->replicates));
    append(next, trough_cells(line.trough->cutoffs.face_face));
    append(next, trough_cells(line.trough->cutoffs.edge_face));
    for (const Estimate& estimate : line.trough->estimates)
      next.push_back(estimate_text(estimate, format, line.trough->replicates));
    cells.push_back(std::move(next));
  }
  return cells;
}

/// All tables, one for each group of quantities, and the tables that follow them.
std::vector<LaidOut> laid_out(const Table& table, View view, Format format) {
  const auto parameters = parameter_names(table);
  const auto lines = lines_of(table, view);
  const std::size_t keys = 2 + parameters.size();
  std::vector<LaidOut> tables;
  const auto add = [&](std::string_view name, std::string_view meaning, std::vector<Cells> cells, std::size_t by,
                       bool requested) {
    if (cells.size() > 1 || tables.empty()) tables.push_back({name, meaning, std::move(cells), by, requested});
  };
  for (const ColumnGroup& group : groups_in(lines, view)) {
    std::vector<Cells> cells{head_of(group, parameters, view, format)};
    for (const TableLine& line : lines) cells.push_back(cells_of(line, group, parameters, view, format));
    add(group.is.name, group.is.meaning, std::move(cells), keys + (view == View::series), tables.empty());
    if (counts_replicates(group, view)) {
      add("goal", goal_meaning, goal_lines(table, parameters, format), keys, true);
      add("differences", difference_meaning, difference_lines(table, parameters, format), keys, true);
    }
    if (group.is == contact_group)
      add("troughs in the angles of all replicates together", trough_meaning, pooled_lines(lines, parameters, format),
          keys + (view == View::series), false);
    if (group.is == contact_group && view == View::nearest)
      add("critical angles", angle_meaning, critical_angle_lines(table, format), 1, false);
  }
  return tables;
}

/// True if a measure in `measures` has a quantity in the group.
bool is_of(std::string_view group, const std::vector<Measure>& measures) {
  const auto all = all_quantities();
  return std::any_of(all.begin(), all.end(), [&](const Quantity& quantity) {
    return quantity.group.name == group && quantity.measure &&
           std::find(measures.begin(), measures.end(), *quantity.measure) != measures.end();
  });
}

/// Lines that explain what a new user sees in the first table.
Cells notes_about(const Table& table) {
  const auto any = [&](int Row::*count) {
    return std::any_of(table.rows.begin(), table.rows.end(), [&](const Row& row) { return row.*count > 0; });
  };
  Cells notes;
  if (any(&Row::excluded)) {
    notes.emplace_back("excluded: replicates that the means leave out because of the flags above the table");
    notes.emplace_back("all: means that include the excluded replicates");
  }
  if (any(&Row::flagged))
    notes.emplace_back("flagged: replicates with a warning (a flag), which \"isojam status DIR\" names");
  return notes;
}

/// Title and meaning of a table in one line.
std::string line_about(const LaidOut& laid, const Table& table) {
  const auto title = laid.name == "differences" ? difference_title(table) : std::string(laid.name);
  return fmt::format("{}: {}", title, laid.meaning);
}

/// Failures at the limit of the density select: these packings are probably the densest.
std::string limit_text(const Table& table) {
  int count = 0;
  for (const auto& row : table.rows) count += row.reached_limit;
  if (count == 0) return "";
  return fmt::format(
      "{} failed because compression reached max_density, so the means probably leave out the densest "
      "packings: increase max_density",
      count == 1 ? "1 replicate" : fmt::format("{} replicates", count));
}

}  // namespace

std::string to_text(const Table& table, View view, const TextOptions& options) {
  std::string text;
  for (const auto& line : {exclusion_text(table), nearest_only_text(table), limit_text(table)}) {
    if (!line.empty()) text += wrapped(line, options.columns) + '\n';
  }
  Cells others;
  bool first = true;
  for (const auto& laid : laid_out(table, view, Format::text)) {
    if (!options.all && !laid.requested && !is_of(laid.name, options.measures)) {
      others.emplace_back(laid.name);
      continue;
    }
    if (!std::exchange(first, false)) text += '\n' + wrapped(line_about(laid, table), options.columns) + '\n';
    text += fitted(laid.lines, laid.keys, options.columns);
  }
  if (options.how_to_see_all.empty()) return text;
  auto notes = notes_about(table);
  if (!others.empty())
    notes.push_back(fmt::format("{} prints more tables: {}", options.how_to_see_all, joined(others, ", ")));
  for (const auto& note : notes) text += (&note == notes.data() ? "\n" : "") + wrapped(note, options.columns) + '\n';
  return text;
}

std::string to_latex(const Table& table, View view) {
  std::string text = exclusion_text(table);
  if (!text.empty()) text = "% " + text + '\n';
  for (const auto& laid : laid_out(table, view, Format::latex)) {
    const auto& lines = laid.lines;
    text += fmt::format("% {}\n\\begin{{tabular}}{{l{}}}\n\\hline\n{} \\\\\n\\hline\n", line_about(laid, table),
                        std::string(lines.front().size() - 1, 'r'), joined(lines.front(), " & "));
    for (std::size_t k = 1; k < lines.size(); ++k) text += joined(lines[k], " & ") + " \\\\\n";
    text += "\\hline\n\\end{tabular}\n";
  }
  return text;
}

}  // namespace isojam
