#include "engine/solve/straight_line.hpp"

#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstddef>
#include <numeric>

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

namespace {

/// In quadruple precision, in software: as elementary.hpp has it, the same bits everywhere. Two thirds of a
/// millisecond.
double student_quantile(double degrees) {
  using Real = boost::multiprecision::cpp_bin_float_quad;
  return static_cast<double>(
      boost::math::quantile(boost::math::students_t_distribution<Real>(Real(degrees)), Real(0.975)));
}

constexpr std::size_t tabulated = 32;

std::array<double, tabulated> first_quantiles() {
  std::array<double, tabulated> values{};
  for (std::size_t n = 1; n < tabulated; ++n) values[n] = student_quantile(static_cast<double>(n));
  return values;
}

}  // namespace

double student_95(double degrees) {
  static const auto table = first_quantiles();
  const bool whole = degrees >= 1 && degrees < static_cast<double>(tabulated) && degrees == std::floor(degrees);
  return whole ? table[static_cast<std::size_t>(degrees)] : student_quantile(degrees);
}

}  // namespace isojam
