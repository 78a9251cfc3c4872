#include "tasks/extras/chart/point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isojam {

std::optional<Spread> spread(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  return Spread{median, values.front(), values.back(), static_cast<int>(n)};
}

std::string reasons_text(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [reason, count] : counts) {
    text += text.empty() ? reason : ", " + reason;
    if (counts.size() > 1) text += fmt::format(" {}", count);
  }
  return text;
}

void TaskRuns::add(const std::string& method, const std::string& setting, double seconds, std::optional<double> error,
                   const std::string& reason, bool failed) {
  auto runs = std::find_if(all_.begin(), all_.end(),
                           [&](const Runs& each) { return each.method == method && each.setting == setting; });
  if (runs == all_.end()) runs = all_.insert(all_.end(), {method, setting, {}, {}, {}, false});
  runs->seconds.push_back(seconds);
  if (error) runs->errors.push_back(*error);
  ++runs->reasons[reason];
  runs->failed |= failed;
}

void TaskRuns::append_to(std::vector<ChartPoint>& points, const std::string& task) const {
  for (const Runs& runs : all_) {
    points.push_back({task, runs.method, runs.setting, spread(runs.seconds), spread(runs.errors),
                      reasons_text(runs.reasons), runs.failed, Json::object()});
  }
}

}  // namespace isojam
