#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "tasks/extras/chart/data.hpp"

namespace isojam {
namespace {

/// The value that is requested if the setting begins with `kind`; nullopt for other settings.
std::optional<double> asked_of(const ChartPoint& point, std::string_view kind) {
  if (!point.setting.starts_with(kind)) return std::nullopt;
  return std::stod(point.setting.substr(kind.size()));
}

constexpr std::string_view by_residual = "residual ", by_energy = "energy change ";

/// Result of a method: number of cases, those in which a setting reaches a residual, and those in which no method
/// reaches it faster.
struct Standing {
  int cases = 0, reached = 0, fastest = 0;
};

std::map<std::string, Standing> standings(std::span<const ChartPoint> points, double residual) {
  std::map<std::string, std::map<std::string, double>> times;  // shortest time by case and method
  std::map<std::string, std::set<std::string>> cases;          // by method
  for (const ChartPoint& point : points) {
    if (!asked_of(point, by_residual)) continue;
    cases[point.method].insert(point.task);
    if (!point.error || !point.seconds || !(point.error->greatest <= residual)) continue;
    const auto [best, is_new] = times[point.task].try_emplace(point.method, point.seconds->median);
    if (!is_new) best->second = std::min(best->second, point.seconds->median);
  }
  std::map<std::string, Standing> all;
  for (const auto& [method, tasks] : cases) all[method].cases = static_cast<int>(tasks.size());
  for (const auto& [task, methods] : times) {
    for (const auto& [method, seconds] : methods) ++all[method].reached;
    ++all[std::min_element(methods.begin(), methods.end(),
                           [](const auto& a, const auto& b) { return a.second < b.second; })
              ->first]
          .fastest;
  }
  return all;
}

/// Lists the methods that reach a residual, those with the most cases first.
std::string residual_text(std::span<const ChartPoint> points, double residual) {
  const auto all = standings(points, residual);
  std::vector<std::pair<std::string, Standing>> order(all.begin(), all.end());
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second.reached, a.second.fastest) > std::pair(b.second.reached, b.second.fastest);
  });
  std::string text;
  for (auto& [method, standing] : order) {
    std::replace(method.begin(), method.end(), '_', ' ');
    text += fmt::format("{}{} in {} of {} cases", text.empty() ? "" : "; ", method, standing.reached, standing.cases);
    if (standing.fastest > 0) text += fmt::format(", as the fastest in {}", standing.fastest);
  }
  return fmt::format("The residual {:g} is reached by {}.", residual, text);
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
      "The paper's rule stops a minimisation at energy changes below {:g}. It stops in {} of {} cases, with residuals "
      "up to {:.2g} and errors of phi_J up to {:.2g}.",
      change, all.size() - unfinished.size(), all.size(), residual, shift);
}

}  // namespace

std::vector<std::string> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias) {
  std::set<double, std::greater<>> residuals;
  for (const ChartPoint& point : equilibrium) {
    if (const auto residual = asked_of(point, by_residual)) residuals.insert(*residual);
  }
  std::vector<std::string> lines;
  for (const double residual : residuals) lines.push_back(residual_text(equilibrium, residual));
  if (auto by_rule = energy_rule_text(equilibrium, bias); !by_rule.empty()) lines.push_back(std::move(by_rule));
  if (lines.empty()) lines.emplace_back("No minimiser was measured.");
  return lines;
}

}  // namespace isojam
