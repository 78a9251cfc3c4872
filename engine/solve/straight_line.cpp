#include "engine/solve/straight_line.hpp"

#include <cmath>
#include <numeric>

#include "engine/arithmetic/distributions.hpp"

namespace isojam {

Line fit_line(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  Line line;
  line.slope = xy / xx;
  line.intercept = mean_y - line.slope * mean_x;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double r = y[k] - line.intercept - line.slope * x[k];
    line.squared_residual += r * r;
  }
  if (x.size() > 2) {
    line.intercept_variance = line.squared_residual / (n - 2) * (1 / n + mean_x * mean_x / xx);
    line.slope_variance = line.squared_residual / (n - 2) / xx;
  }
  return line;
}

double student_95(double degrees) { return student_two_sided(0.95, std::lround(degrees)); }

}  // namespace isojam
