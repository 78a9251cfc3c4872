#include "tasks/extras/chart/conclusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string_view>

namespace isojam {
namespace {

/// Shortest time for each method and case, over the points that reach the residual. Cases without such a point are
/// kept.
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

/// Text such as "6 of 6".
std::string share(const Standing& standing) { return fmt::format("{} of {}", standing.reached, standing.tasks); }

std::string fastest_line(std::span<const ChartPoint> points, double residual) {
  const auto asked =
      fmt::format("equilibria with a residual of {:g} (a case is a solid at a distance from jamming): ", residual);
  const auto order = standings(points, residual);
  if (order.empty()) return asked + "nothing was measured";
  const Standing& first = order.front();
  if (first.reached == 0) return asked + "no method reaches it in any case";
  auto line = asked + fmt::format("{} reaches it in most cases, {}, in {:.3g} s together", first.method, share(first),
                                  first.seconds);
  for (std::size_t k = 1; k < order.size(); ++k) line += fmt::format("; {} {}", order[k].method, share(order[k]));
  return line;
}

/// The value that is requested if the setting begins with `kind`; nullopt for other settings.
std::optional<double> asked_of(const ChartPoint& point, std::string_view kind) {
  if (!point.setting.starts_with(kind)) return std::nullopt;
  return std::stod(point.setting.substr(kind.size()));
}

constexpr std::string_view by_residual = "residual ", by_energy = "energy change ";

/// Lists the methods that missed each requested residual. A method that missed one residual was not run for smaller
/// ones; it counts as missing these too.
std::string missed_text(std::span<const ChartPoint> points) {
  std::set<double, std::greater<>> asked;
  std::vector<ChartPoint> of_residuals;
  for (const ChartPoint& point : points) {
    const auto residual = asked_of(point, by_residual);
    if (!residual) continue;
    asked.insert(*residual);
    of_residuals.push_back(point);
  }
  std::string text;
  for (const double residual : asked) {
    std::string missed;
    for (const Standing& standing : standings(of_residuals, residual)) {
      if (standing.reached == standing.tasks) continue;
      missed += fmt::format("{}{} in {} of {} cases", missed.empty() ? "" : ", ", standing.method,
                            standing.tasks - standing.reached, standing.tasks);
    }
    text += fmt::format("; {:g}, missed by {}", residual, missed.empty() ? "none" : missed);
  }
  return text.empty() ? "" : "requested residuals" + text.replace(0, 1, ":");
}

/// Describes the paper's stopping rule, which reports success at any residual: how often it stops, and the largest
/// residual and error of φ_J.
std::string energy_rule_text(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias) {
  double residual = 0, shift = 0, change = 0;
  std::set<std::string> unfinished, all;
  for (const ChartPoint& point : equilibrium) {
    const auto asked = asked_of(point, by_energy);
    if (!asked) continue;
    change = change == 0 ? *asked : std::min(change, *asked);
    all.insert(point.task);
    if (point.failed) unfinished.insert(point.task);
    if (point.error) residual = std::max(residual, point.error->greatest);
  }
  for (const ChartPoint& point : bias) {
    if (asked_of(point, by_energy) && point.error) shift = std::max(shift, point.error->greatest);
  }
  if (all.empty()) return "";
  return fmt::format(
      "if a minimisation stops at energy changes below {:g} instead of a residual: it stops in {} of {} cases, with "
      "residuals up to {:.2g} and errors of phi_J up to {:.2g}",
      change, all.size() - unfinished.size(), all.size(), residual, shift);
}

std::string failed_line(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias) {
  const auto missed = missed_text(equilibrium), by_rule = energy_rule_text(equilibrium, bias);
  if (missed.empty() && by_rule.empty()) return "requested residuals: nothing was measured";
  return missed + (missed.empty() || by_rule.empty() ? "" : "; ") + by_rule;
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
  return {fastest_line(equilibrium, 1e-6), fastest_line(equilibrium, 1e-9), failed_line(equilibrium, bias)};
}

}  // namespace isojam
