#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tasks/extras/chart/data.hpp"
#include "tasks/tables/fitted.hpp"

namespace isojam {
namespace {

std::string number(double x) { return fmt::format("{:.2e}", x); }

Cells row_of(const ChartPoint& point) {
  Cells row{point.task, point.method, point.setting, "-", "", "-", "", "", point.stopped};
  if (point.seconds) {
    row[3] = number(point.seconds->median);
    row[4] = std::to_string(point.seconds->n);
  }
  if (point.error) {
    row[5] = number(point.error->median);
    row[6] = number(point.error->greatest);
    row[7] = std::to_string(point.error->n);
  }
  if (point.failed) row.back() += "  FAILED";
  return row;
}

std::string ended_text(FamilyEnd end) {
  switch (end) {
    case FamilyEnd::complete: return "";
    case FamilyEnd::cut: return " (interrupted by the time limit)";
    case FamilyEnd::interrupted: return " (interrupted by a signal)";
  }
  return "";
}

std::string family_text(const ChartFamily& family) {
  std::vector<Cells> rows{{"case", "method", "setting", "seconds", "n", "error", "greatest", "n", "stopped"}};
  for (const ChartPoint& point : family.points) rows.push_back(row_of(point));
  return fmt::format("{}{}: seconds of one thread, {}\n{}\n", family.name, ended_text(family.ended), family.error_is,
                     fitted(rows, 1, 0));
}

/// A line for each regime with its settings, and a line for each of its methods with a letter for every setting, or a
/// dot if the method was not tested.
std::string atlas_text(const ChartAtlas& atlas) {
  std::array<int, 3> counts{};
  Cells regimes;
  std::map<std::string, Cells> settings;
  std::map<std::pair<std::string, std::string>, std::string> letters;  // by regime and method
  const auto place = [](Cells& names, const std::string& name) {
    const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (at == names.size()) names.push_back(name);
    return at;
  };
  for (const AtlasRow& row : atlas.rows) {
    ++counts[static_cast<std::size_t>(row.verdict)];
    place(regimes, row.regime);
    const std::size_t at = place(settings[row.regime], row.setting);
    std::string& line = letters[{row.regime, row.method + (row.standard ? " *" : "")}];
    line.resize(std::max(line.size(), at + 1), '.');
    line[at] = to_string(row.verdict).front();
  }
  std::string text = fmt::format(
      "atlas{}: {} cells hold (h), {} refuse (r), {} fail (f); * marks the methods of isojam; chart.html has the "
      "reasons\n",
      ended_text(atlas.ended), counts[0], counts[1], counts[2]);
  for (const std::string& regime : regimes) {
    text += fmt::format("{}: {}\n", regime, joined(settings[regime], ", "));
    for (auto at = letters.lower_bound({regime, ""}); at != letters.end() && at->first.first == regime; ++at)
      text += fmt::format("  {:<56}{}\n", at->first.second, at->second);
  }
  return text + "\n";
}

}  // namespace

std::string text_table(const ChartResult& result) {
  std::string text, costs;
  for (const ChartFamily& family : result.families) text += family_text(family);
  if (result.atlas) text += atlas_text(*result.atlas);
  for (const PartCost& cost : result.costs)
    costs += fmt::format("{}{} {:.1f}", costs.empty() ? "CPU seconds: " : ", ", cost.part, cost.cpu_seconds);
  return text + costs + "\n";
}

}  // namespace isojam
