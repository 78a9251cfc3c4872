#include "tasks/extras/chart/data.hpp"

#include <algorithm>

#include "tasks/io/version.hpp"

namespace isojam {
namespace {

Json to_json(const std::optional<Spread>& spread) {
  if (!spread) return nullptr;
  return {{"median", spread->median}, {"least", spread->least}, {"greatest", spread->greatest}, {"n", spread->n}};
}

bool usable(const ChartPoint& point) { return !point.failed && point.seconds && point.error; }

/// True if the point is on the Pareto front of its case: no other point is better in time or error and not worse in the
/// other quantity. Times and errors are medians. Of several equal points, only the first is on the front.
bool on_front(std::span<const ChartPoint> points, const ChartPoint& point) {
  const auto is_beaten_by = [&](const ChartPoint& other) {
    if (!usable(other) || other.task != point.task) return false;
    const auto here = std::pair(point.seconds->median, point.error->median),
               there = std::pair(other.seconds->median, other.error->median);
    return here == there ? &other < &point : there.first <= here.first && there.second <= here.second;
  };
  return usable(point) && std::none_of(points.begin(), points.end(), is_beaten_by);
}

Json to_json(const ChartPoint& point, bool is_on_front) {
  return {{"case", point.task},
          {"method", point.method},
          {"setting", point.setting},
          {"seconds", to_json(point.seconds)},
          {"error", to_json(point.error)},
          {"stopped", point.stopped},
          {"failed", point.failed},
          {"on_front", is_on_front},
          {"further", point.further}};
}

Json to_json(const ChartFamily& family) {
  Json points = Json::array();
  for (const ChartPoint& point : family.points) points.push_back(to_json(point, on_front(family.points, point)));
  return {{"name", family.name},
          {"error_is", family.error_is},
          {"note", family.note},
          {"ended", to_string(family.ended)},
          {"points", std::move(points)}};
}

Json to_json(const AtlasRow& row) {
  return {{"regime", row.regime},
          {"setting", row.setting},
          {"method", row.method},
          {"standard", row.standard},
          {"verdict", to_string(row.verdict)},
          {"figure", row.figure},
          {"reason", row.reason}};
}

Json to_json(const std::optional<ChartAtlas>& atlas) {
  if (!atlas) return nullptr;
  Json rows = Json::array();
  for (const AtlasRow& row : atlas->rows) rows.push_back(to_json(row));
  return {{"ended", to_string(atlas->ended)}, {"rows", std::move(rows)}};
}

}  // namespace

std::span<const ChartPoint> points_of(std::span<const ChartFamily> families, std::string_view name) {
  for (const ChartFamily& family : families) {
    if (family.name == name) return family.points;
  }
  return {};
}

Json chart_data(const ChartConfig& config, const ChartResult& result) {
  Json all = Json::array();
  for (const ChartFamily& family : result.families) all.push_back(to_json(family));
  Json lines = Json::array();
  for (const auto& line : conclusion(points_of(result.families, "equilibrium"), points_of(result.families, "bias")))
    lines.push_back(line);
  Json costs = Json::object();
  for (const PartCost& cost : result.costs) costs[cost.part] = cost.cpu_seconds;
  return {{"schema", "isojam.chart.v2"},
          {"program", {{"version", version()}, {"git", git_hash()}, {"compiler", compiler()}}},
          {"threads", 1},
          {"config", isojam::to_json(config)},
          {"families", std::move(all)},
          {"atlas", to_json(result.atlas)},
          {"cpu_seconds", std::move(costs)},
          {"conclusion", std::move(lines)}};
}

}  // namespace isojam
