#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tasks/extras/chart/atlas/atlas_runs.hpp"
#include "tasks/extras/chart/conclusion.hpp"
#include "tasks/extras/chart/data.hpp"

namespace isojam {
namespace {

using Row = std::vector<std::string>;

std::string number(double x) { return fmt::format("{:.2e}", x); }

Row row_of(const ChartPoint& point) {
  Row row{point.task, point.method, point.setting, "-", "", "-", "", "", point.stopped};
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

/// Number of characters that a terminal shows. Continuation bytes of UTF-8 have no width.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Text with aligned columns. All rows must have as many columns as the first row.
std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) line += row[k] + std::string(widths[k] - width(row[k]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string ended_text(FamilyEnd end) {
  switch (end) {
    case FamilyEnd::complete: return "";
    case FamilyEnd::cut: return " (interrupted by the time limit)";
    case FamilyEnd::interrupted: return " (interrupted by a signal)";
  }
  return "";
}

std::string fits_text(const std::vector<GrowthFit>& fits) {
  std::string text;
  for (const GrowthFit& fit : fits) {
    const auto half_width = fit.half_width ? fmt::format(" ± {:.2f}", *fit.half_width) : "";
    text +=
        fmt::format("{}, {}: seconds grow as N^x with x = {:.2f}{}\n", fit.task, fit.method, fit.exponent, half_width);
  }
  return text;
}

std::string family_text(const ChartFamily& family) {
  std::vector<Row> rows{{"case", "method", "setting", "seconds", "n", "error", "greatest", "n", "stopped"}};
  for (const ChartPoint& point : family.points) rows.push_back(row_of(point));
  return fmt::format("{}{}: seconds of one thread, {}\n{}{}\n", family.name, ended_text(family.ended), family.error_is,
                     aligned(rows), fits_text(family.fits));
}

/// A row of the table. Names that are the same as in the row above are omitted.
Row row_of(const AtlasRun& run, const AtlasRun* above) {
  constexpr std::array<const char*, 3> verdicts{"holds", "REFUSES", "FAILS"};
  const bool same_regime = above != nullptr && above->regime == run.regime;
  const bool same_method = same_regime && above->method == run.method;
  const bool holds = run.verdict == AtlasVerdict::holds;
  return {same_regime ? "" : run.regime, same_method ? "" : run.method + (run.standard ? " *" : ""),
          verdicts[static_cast<std::size_t>(run.verdict)], run.settings,
          holds ? "" : fmt::format("{} ({})", run.reason, run.figure)};
}

std::string atlas_text(const ChartAtlas& atlas) {
  std::array<int, 3> counts{};
  for (const AtlasRow& row : atlas.rows) ++counts[static_cast<std::size_t>(row.verdict)];
  std::vector<Row> rows{{"regime", "method", "verdict", "settings", "reason (result of the first)"}};
  const std::vector<AtlasRun> runs = atlas_runs(atlas.rows);
  for (std::size_t k = 0; k < runs.size(); ++k) rows.push_back(row_of(runs[k], k == 0 ? nullptr : &runs[k - 1]));
  return fmt::format("atlas{}: {} cells hold, {} refuse, {} fail; * marks the methods of isojam\n{}\n",
                     ended_text(atlas.ended), counts[0], counts[1], counts[2], aligned(rows));
}

std::string costs_text(const std::vector<PartCost>& costs) {
  std::string text;
  for (const PartCost& cost : costs)
    text += fmt::format("{}{} {:.1f}", text.empty() ? "CPU seconds: " : ", ", cost.part, cost.cpu_seconds);
  return text + "\n";
}

}  // namespace

std::string text_table(const ChartResult& result) {
  std::string text;
  for (const ChartFamily& family : result.families) text += family_text(family);
  if (result.atlas) text += atlas_text(*result.atlas);
  text += costs_text(result.costs);
  for (const auto& line : conclusion(points_of(result.families, "equilibrium"), points_of(result.families, "bias")))
    text += line + "\n";
  return text;
}

}  // namespace isojam
