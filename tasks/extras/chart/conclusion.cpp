#include "tasks/extras/chart/conclusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

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

/// The value that is requested if the setting begins with `kind`; nullopt for other settings.
std::optional<double> asked_of(const ChartPoint& point, std::string_view kind) {
  if (!point.setting.starts_with(kind)) return std::nullopt;
  return std::stod(point.setting.substr(kind.size()));
}

constexpr std::string_view by_residual = "residual ", by_energy = "energy change ";

/// Points of minimisations that requested a residual, and these residuals in descending order.
struct OfResiduals {
  std::vector<ChartPoint> points;
  std::set<double, std::greater<>> asked;
};

OfResiduals of_residuals(std::span<const ChartPoint> points) {
  OfResiduals chosen;
  for (const ChartPoint& point : points) {
    const auto residual = asked_of(point, by_residual);
    if (!residual) continue;
    chosen.asked.insert(*residual);
    chosen.points.push_back(point);
  }
  return chosen;
}

/// Distance to jamming of a case, from a name such as "octahedron, Δφ = 0.015"; nullopt if the name has none.
std::optional<double> distance_of(const std::string& task) {
  constexpr std::string_view before = "Δφ = ";
  const auto at = task.rfind(before);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(task.substr(at + before.size()));
}

/// Text such as " at Δφ ≤ 0.01" if these cases are exactly those nearest jamming or farthest from it; empty if they are
/// not. `others` are all other cases.
std::string where_text(const std::vector<std::string>& tasks, const std::vector<std::string>& others) {
  const auto range = [](const std::vector<std::string>& names) {
    std::pair<double, double> ends{std::numeric_limits<double>::infinity(), -1};
    for (const auto& name : names) {
      const double distance = distance_of(name).value_or(std::numeric_limits<double>::quiet_NaN());
      ends = {std::fmin(ends.first, distance), std::fmax(ends.second, distance)};
    }
    return ends;
  };
  if (tasks.empty() || others.empty()) return "";
  const auto [low, high] = range(tasks);
  const auto [other_low, other_high] = range(others);
  if (high >= 0 && high < other_low) return fmt::format(" at Δφ ≤ {:g}", high);
  if (other_high >= 0 && low > other_high) return fmt::format(" at Δφ ≥ {:g}", low);
  return "";
}

/// Text such as "a", "a and b", or "a, b and c".
std::string list_text(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

/// A method as in a sentence, such as "conjugate gradient".
std::string readable(std::string method) {
  std::replace(method.begin(), method.end(), '_', ' ');
  return method;
}

/// States which methods reach a residual in all cases.
std::string arrival_text(const std::vector<Standing>& order, double residual) {
  const int cases = std::max_element(order.begin(), order.end(), [](const auto& a, const auto& b) {
                      return a.tasks < b.tasks;
                    })->tasks;
  std::vector<std::string> all;
  for (const Standing& each : order) {
    if (each.reached == cases) all.push_back(readable(each.method));
  }
  const auto reached = fmt::format("The residual {:g} is reached", residual);
  const auto in_all = cases == 1 ? std::string("in the only case") : fmt::format("in all {} cases", cases);
  const Standing& first = order.front();
  if (first.reached == 0) return fmt::format("{} by no method in any case.", reached);
  if (all.empty()) {
    return fmt::format("{} by no method {}; {} reaches it in the most, {} of {}.", reached, in_all,
                       readable(first.method), first.reached, first.tasks);
  }
  if (all.size() == order.size() && all.size() > 1) return fmt::format("{} by all methods {}.", reached, in_all);
  return fmt::format("{} {} only by {}.", reached, in_all, list_text(all));
}

using Names = std::vector<std::string>;

/// Text such as "newton in 5 of 6 cases and fire in 1". It lists each method with the number of its cases, the largest
/// number first. The text of where_text() follows if it is not empty. `others` are the other cases of each method.
std::string counts_text(const std::map<std::string, Names>& by_method, const std::map<std::string, Names>& others) {
  std::vector<std::pair<std::string, Names>> order(by_method.begin(), by_method.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  Names parts;
  for (const auto& [method, tasks] : order) {
    const auto& rest = others.at(method);
    const auto of = parts.empty() ? fmt::format(" of {} cases", tasks.size() + rest.size()) : "";
    parts.push_back(fmt::format("{} in {}{}{}", readable(method), tasks.size(), of, where_text(tasks, rest)));
  }
  return list_text(parts);
}

/// States which method is the fastest, and where.
std::string fastest_text(const Times& times) {
  std::map<std::string, std::pair<double, std::string>> best;  // by case
  for (const auto& [method, tasks] : times) {
    for (const auto& [task, seconds] : tasks) {
      if (!seconds) continue;
      const auto [place, is_new] = best.try_emplace(task, *seconds, method);
      if (!is_new && *seconds < place->second.first) place->second = {*seconds, method};
    }
  }
  std::map<std::string, Names> won, lost;
  for (const auto& [task, winner] : best) won[winner.second].push_back(task);
  for (const auto& [method, tasks] : won) {
    for (const auto& [task, winner] : best) {
      if (winner.second != method) lost[method].push_back(task);
    }
    lost.try_emplace(method);
  }
  if (won.empty()) return "";
  if (won.size() == 1) return fmt::format(" {} is the fastest in all of them.", readable(won.begin()->first));
  return fmt::format(" The fastest method is {}.", counts_text(won, lost));
}

/// States which methods miss the residual, in how many cases, and where.
std::string missed_text(const Times& times) {
  std::map<std::string, Names> missed, reached;
  for (const auto& [method, tasks] : times) {
    Names without;
    for (const auto& [task, seconds] : tasks) (seconds ? reached[method] : without).push_back(task);
    reached.try_emplace(method);
    if (!without.empty()) missed[method] = std::move(without);
  }
  return missed.empty() ? "" : fmt::format(" It is missed by {}.", counts_text(missed, reached));
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
      "up "
      "to {:.2g} and errors of phi_J up to {:.2g}.",
      change, all.size() - unfinished.size(), all.size(), residual, shift);
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

std::vector<std::string> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias) {
  const auto [points, asked] = of_residuals(equilibrium);
  std::vector<std::string> lines;
  for (const double residual : asked) {
    const auto times = fastest(points, residual);
    lines.push_back(arrival_text(standings(points, residual), residual) + fastest_text(times) + missed_text(times));
  }
  if (auto by_rule = energy_rule_text(equilibrium, bias); !by_rule.empty()) lines.push_back(std::move(by_rule));
  if (lines.empty()) lines.emplace_back("No minimiser was measured.");
  return lines;
}

}  // namespace isojam
