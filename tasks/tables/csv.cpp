#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tasks/io/rows.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/tables/lines.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

std::string number(const std::optional<double>& x) { return x ? compact(Json(*x)) : ""; }

/// Headings of the leading columns.
Cells head_of(const std::vector<std::string>& parameters, View view) {
  Cells head{"solid", "particles"};
  for (const auto& name : parameters) head.push_back(parameter_head(name));
  head.insert(head.end(), {"replicates", "failed", "flagged", "excluded", "over"});
  if (view == View::series) head.emplace_back("delta_phi");
  return head;
}

Cells begin_of(const TableLine& line, const std::vector<std::string>& parameters) {
  const Row& row = *line.row;
  Cells cells{std::string(to_string(row.solid)), std::to_string(row.particles)};
  for (const auto& name : parameters) cells.push_back(parameter_text(row, name));
  for (const int count : {row.replicates, row.failed, row.flagged, row.excluded})
    cells.push_back(std::to_string(count));
  cells.emplace_back(to_string(line.over));
  if (line.delta_phi) cells.push_back(number(line.delta_phi));
  return cells;
}

/// Names of the columns of an estimate, in the order of cells_of().
constexpr std::array parts{"mean", "low", "high", "sd", "n", "bootstrap_low", "bootstrap_high"};

Cells cells_of(const Estimate& estimate) {
  const auto low = [](const auto& x) { return number(x ? std::optional(x->low) : std::nullopt); };
  const auto high = [](const auto& x) { return number(x ? std::optional(x->high) : std::nullopt); };
  return {number(estimate.mean),      low(estimate.ci95),        high(estimate.ci95),       number(estimate.sd),
          std::to_string(estimate.n), low(estimate.bootstrap95), high(estimate.bootstrap95)};
}

/// Lines grouped by row. In the view of the nearest states, a line with the differences from the base follows each row.
std::vector<TableLine> csv_lines(const Table& table, View view) {
  std::vector<TableLine> lines;
  const auto plain = lines_of(table, view);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const Row& row = *plain[k].row;
    lines.push_back(plain[k]);
    const bool last = k + 1 == plain.size() || plain[k + 1].row != &row;
    if (last && view == View::nearest && row.differences) lines.push_back(difference_line(row));
  }
  return lines;
}

void append(Cells& cells, const Cells& more) { cells.insert(cells.end(), more.begin(), more.end()); }

/// Indices in all_quantities() of the quantities that have a value in at least one line. If `first_group` is true, also
/// all quantities of the first group.
std::vector<std::size_t> quantities_in(const std::vector<TableLine>& lines, bool first_group) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < all_quantities().size(); ++i) {
    if ((first_group && is_always_listed(all_quantities()[i])) ||
        std::any_of(lines.begin(), lines.end(), [&](const TableLine& line) { return (*line.estimates)[i].n > 0; }))
      list.push_back(i);
  }
  return list;
}

/// Estimates by the troughs of all replicates together; null if the line has none.
const Estimate* pooled_of(const TableLine& line, std::size_t i) {
  return line.trough ? &line.trough->estimates[i] : nullptr;
}

/// Indices of these estimates that have a value in at least one line.
std::vector<std::size_t> pooled_in(const std::vector<TableLine>& lines) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < PooledTrough::names.size(); ++i) {
    if (std::any_of(lines.begin(), lines.end(), [&](const TableLine& line) {
          const Estimate* estimate = pooled_of(line, i);
          return estimate && estimate->n > 0;
        }))
      list.push_back(i);
  }
  return list;
}

std::string line_of(Cells cells) {
  for (auto& cell : cells) cell = csv_field(cell);
  return joined(cells, ",") + '\n';
}

}  // namespace

std::string to_csv(const Table& table, View view) {
  const auto parameters = parameter_names(table);
  const auto lines = csv_lines(table, view);
  const auto quantities = quantities_in(lines, true);
  auto head = head_of(parameters, view);
  for (const auto i : quantities) {
    for (const auto part : parts) head.push_back(fmt::format("{}_{}", all_quantities()[i].name, part));
  }
  const auto pooled = pooled_in(lines);
  for (const auto i : pooled) {
    for (const auto part : parts) head.push_back(fmt::format("{}_{}", PooledTrough::names[i], part));
  }
  head.emplace_back(residual_column);
  auto text = line_of(head);
  for (const TableLine& line : lines) {
    auto cells = begin_of(line, parameters);
    for (const auto i : quantities) append(cells, cells_of((*line.estimates)[i]));
    for (const auto i : pooled) {
      const Estimate* estimate = pooled_of(line, i);
      append(cells, cells_of(estimate ? *estimate : Estimate{}));
    }
    cells.push_back(line.over == Over::difference ? "" : number(line.row->residual));
    text += line_of(cells);
  }
  return text;
}

std::string to_long_csv(const Table& table, View view) {
  const auto parameters = parameter_names(table);
  const auto lines = csv_lines(table, view);
  auto head = head_of(parameters, view);
  head.emplace_back("quantity");
  append(head, {parts.begin(), parts.end()});
  auto text = line_of(head);
  const auto quantities = quantities_in(lines, false);
  for (const TableLine& line : lines) {
    for (const auto i : quantities) {
      auto cells = begin_of(line, parameters);
      cells.emplace_back(all_quantities()[i].name);
      append(cells, cells_of((*line.estimates)[i]));
      text += line_of(cells);
    }
    for (std::size_t i = 0; line.trough && i < PooledTrough::names.size(); ++i) {
      auto cells = begin_of(line, parameters);
      cells.emplace_back(PooledTrough::names[i]);
      append(cells, cells_of(line.trough->estimates[i]));
      text += line_of(cells);
    }
  }
  return text;
}

}  // namespace isojam
