#include "engine/analysis/power_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/straight_line.hpp"

namespace isojam {

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw std::invalid_argument("each x needs one y");
  std::vector<double> log_x, log_y;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(x[k] > 0) || !(y[k] > 0) || !std::isfinite(x[k]) || !std::isfinite(y[k])) continue;
    log_x.push_back(nearest::log(x[k]));
    log_y.push_back(nearest::log(y[k]));
  }
  if (log_x.empty()) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(log_x.begin(), log_x.end());
  if (!(*least < *greatest)) return std::nullopt;
  const Line line = fit_line(log_x, log_y);
  PowerLaw law;
  law.exponent = line.slope;
  law.prefactor = nearest::exp(line.intercept);
  law.points = static_cast<int>(log_x.size());
  law.standard_error = std::sqrt(line.slope_variance);
  if (law.points > 2) law.ci95_half_width = student_95(law.points - 2) * law.standard_error;
  return law;
}

}  // namespace isojam
