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

}  // namespace isojam
