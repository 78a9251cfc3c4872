#include "tasks/extras/chart/data.hpp"

#include <map>

#include "tasks/extras/chart/conclusion.hpp"
#include "tasks/extras/chart/front.hpp"
#include "tasks/io/version.hpp"

namespace isojam {
namespace {

Json to_json(const std::optional<Spread>& spread) {
  if (!spread) return nullptr;
  return {{"median", spread->median}, {"least", spread->least}, {"greatest", spread->greatest}, {"n", spread->n}};
}

/// For each point: true if it is on the Pareto front of its case (no other point is both faster and more accurate).
std::vector<bool> on_fronts(std::span<const ChartPoint> points) {
  std::map<std::string, std::vector<std::size_t>> tasks;
  for (std::size_t k = 0; k < points.size(); ++k) tasks[points[k].task].push_back(k);
  std::vector<bool> on_front(points.size(), false);
  for (const auto& [task, indices] : tasks) {
    std::vector<ChartPoint> some;
    for (const std::size_t k : indices) some.push_back(points[k]);
    for (const std::size_t k : pareto_front(some)) on_front[indices[k]] = true;
  }
  return on_front;
}

Json to_json(const ChartPoint& point, bool on_front) {
  return {{"case", point.task},
          {"method", point.method},
          {"setting", point.setting},
          {"seconds", to_json(point.seconds)},
          {"error", to_json(point.error)},
          {"stopped", point.stopped},
          {"failed", point.failed},
          {"on_front", on_front},
          {"further", point.further}};
}

Json to_json(const GrowthFit& fit) {
  return {{"case", fit.task},           {"method", fit.method},
          {"exponent", fit.exponent},   {"half_width", fit.half_width ? Json(*fit.half_width) : Json(nullptr)},
          {"prefactor", fit.prefactor}, {"n", fit.n}};
}

Json to_json(const ChartFamily& family) {
  Json points = Json::array();
  const auto on_front = on_fronts(family.points);
  for (std::size_t k = 0; k < family.points.size(); ++k) points.push_back(to_json(family.points[k], on_front[k]));
  Json fits = Json::array();
  for (const GrowthFit& fit : family.fits) fits.push_back(to_json(fit));
  return {{"name", family.name},         {"error_is", family.error_is},
          {"note", family.note},         {"ended", to_string(family.ended)},
          {"points", std::move(points)}, {"fits", std::move(fits)}};
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
  return {{"schema", "isojam.chart.v1"},
          {"program", {{"version", version()}, {"git", git_hash()}, {"compiler", compiler()}}},
          {"threads", 1},
          {"config", isojam::to_json(config)},
          {"families", std::move(all)},
          {"atlas", to_json(result.atlas)},
          {"cpu_seconds", std::move(costs)},
          {"conclusion", std::move(lines)}};
}

}  // namespace isojam
