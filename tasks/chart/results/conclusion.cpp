#include "tasks/chart/results/conclusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace isojam {
namespace {

/// Fastest time per method and task, of points within; a method's tasks without one stay.
using Times = std::map<std::string, std::map<std::string, std::optional<double>>>;

Times fastest(std::span<const ChartPoint> points, double residual) {
  Times times;
  for (const ChartPoint& point : points) {
    auto& best = times[point.method][point.task];
    if (!point.error || !point.seconds || !(point.error->greatest <= residual)) continue;
    if (!best || point.seconds->median < *best) best = point.seconds->median;
  }
  return times;
}

std::string fastest_line(std::span<const ChartPoint> points, double residual) {
  const auto order = standings(points, residual);
  if (order.empty()) return fmt::format("within {:g}: nothing was measured", residual);
  const Standing& first = order.front();
  if (first.reached == 0) return fmt::format("within {:g}: no method in any case", residual);
  auto line = fmt::format("within {:g}: {} is fastest, {} of {} cases in {:.3g} s", residual, first.method,
                          first.reached, first.tasks, first.seconds);
  for (std::size_t k = 1; k < order.size(); ++k)
    line += fmt::format("; {} {} of {}", order[k].method, order[k].reached, order[k].tasks);
  return line;
}

/// Share of a method's tasks in which some setting failed.
std::string failed_text(std::span<const ChartPoint> points) {
  if (points.empty()) return "nothing was measured";
  std::map<std::string, std::pair<std::set<std::string>, std::set<std::string>>> tasks;  // failed, all
  for (const ChartPoint& point : points) {
    auto& [failed, all] = tasks[point.method];
    all.insert(point.task);
    if (point.failed) failed.insert(point.task);
  }
  std::string text;
  for (const auto& [method, counts] : tasks) {
    if (counts.first.empty()) continue;
    text += fmt::format("{}{} in {} of {} cases", text.empty() ? "" : ", ", method, counts.first.size(),
                        counts.second.size());
  }
  return text.empty() ? "nothing" : text;
}

bool by_energy(const ChartPoint& point) { return point.setting.starts_with("energy change"); }

/// Where stopping by the energy alone ends, though it says that it is done.
std::string energy_rule_text(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias) {
  double residual = 0, shift = 0;
  for (const ChartPoint& point : equilibrium) {
    if (by_energy(point) && point.error) residual = std::max(residual, point.error->greatest);
  }
  for (const ChartPoint& point : bias) {
    if (by_energy(point) && point.error) shift = std::max(shift, point.error->greatest);
  }
  if (residual == 0) return "";
  return fmt::format(
      "; by energy, content or out of evaluations, residuals are up to {:.1g} and phi_J is off by up to {:.1g}",
      residual, shift);
}

}  // namespace

std::vector<Standing> standings(std::span<const ChartPoint> points, double residual) {
  std::vector<Standing> all;
  for (const auto& [method, tasks] : fastest(points, residual)) {
    Standing standing{method, 0, static_cast<int>(tasks.size()), 0};
    for (const auto& [task, seconds] : tasks) {
      standing.reached += seconds.has_value();
      standing.seconds += seconds.value_or(0);
    }
    all.push_back(standing);
  }
  std::stable_sort(all.begin(), all.end(), [](const Standing& a, const Standing& b) {
    return a.reached != b.reached ? a.reached > b.reached : a.seconds < b.seconds;
  });
  return all;
}

std::array<std::string, 3> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias) {
  return {fastest_line(equilibrium, 1e-6), fastest_line(equilibrium, 1e-9),
          "failed: " + failed_text(equilibrium) + energy_rule_text(equilibrium, bias)};
}

}  // namespace isojam
