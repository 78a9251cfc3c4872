#include <fmt/format.h>

#include "tasks/measure/quantity.hpp"
#include "tasks/tables/lines.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

std::string number(const std::optional<double>& x) { return x ? Json(*x).dump() : ""; }

/// What a line begins with.
Cells head_of(const std::vector<std::string>& parameters, View view) {
  Cells head{"solid", "particles"};
  head.insert(head.end(), parameters.begin(), parameters.end());
  head.insert(head.end(), {"replicates", "failed", "flagged", "excluded", "over"});
  if (view == View::series) head.emplace_back("delta_phi");
  return head;
}

Cells begin_of(const Line& line, const std::vector<std::string>& parameters) {
  const Row& row = *line.row;
  Cells cells{std::string(to_string(row.solid)), std::to_string(row.particles)};
  for (const auto& name : parameters) cells.push_back(parameter_text(row, name));
  for (const int count : {row.replicates, row.failed, row.flagged, row.excluded})
    cells.push_back(std::to_string(count));
  cells.emplace_back(line.of_all ? "all" : "kept");
  if (line.delta_phi) cells.push_back(number(line.delta_phi));
  return cells;
}

void append(const Estimate& estimate, Cells& cells) {
  const auto interval = [&](const std::optional<Interval>& x) {
    cells.push_back(number(x ? std::optional(x->low) : std::nullopt));
    cells.push_back(number(x ? std::optional(x->high) : std::nullopt));
  };
  cells.push_back(number(estimate.mean));
  interval(estimate.ci95);
  cells.push_back(number(estimate.sd));
  cells.push_back(std::to_string(estimate.n));
  interval(estimate.bootstrap95);
}

}  // namespace

std::string to_csv(const Table& table, View view) {
  const auto parameters = parameter_names(table);
  auto head = head_of(parameters, view);
  for (const auto& quantity : all_quantities()) {
    for (const auto part : {"mean", "low", "high", "sd", "n", "bootstrap_low", "bootstrap_high"}) {
      head.push_back(fmt::format("{}_{}", quantity.name, part));
    }
  }
  head.emplace_back("residual");
  auto text = joined(head, ",") + '\n';
  for (const Line& line : lines_of(table, view)) {
    auto cells = begin_of(line, parameters);
    for (const auto& estimate : *line.estimates) append(estimate, cells);
    cells.push_back(number(line.row->residual));
    text += joined(cells, ",") + '\n';
  }
  return text;
}

}  // namespace isojam
