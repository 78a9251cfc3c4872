#include "engine/solve/jamming_point.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace isojam {

namespace {

/// Least-squares line y = intercept + slope·x.
struct Line {
  double intercept = 0, slope = 0;
  double squared_residual = 0;
  double intercept_variance = 0;  ///< 0 with two points
};

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
  if (x.size() > 2) line.intercept_variance = line.squared_residual / (n - 2) * (1 / n + mean_x * mean_x / xx);
  return line;
}

double sixth_root(double energy) { return std::cbrt(std::sqrt(energy)); }

/// φ against (E/N)^(1/6): φ_J is the intercept.
Line fit_asymptote(std::span<const EnergyPoint> states, std::span<const int> chosen) {
  std::vector<double> root, density;
  for (const int k : chosen) {
    root.push_back(sixth_root(states[static_cast<std::size_t>(k)].energy_per_particle));
    density.push_back(states[static_cast<std::size_t>(k)].density);
  }
  return fit_line(root, density);
}

/// x of E ∝ (φ − φ_J)^x with both free: for each φ_J a line in logarithms.
double free_exponent(std::span<const EnergyPoint> states, std::span<const int> chosen, double window) {
  if (chosen.size() < 4) return 0;
  const double nearest = states[static_cast<std::size_t>(chosen.front())].density;
  std::vector<double> log_energy;
  for (const int k : chosen) log_energy.push_back(std::log(states[static_cast<std::size_t>(k)].energy_per_particle));
  const auto fit_at = [&](double gap) {
    std::vector<double> log_distance;
    for (const int k : chosen)
      log_distance.push_back(std::log(states[static_cast<std::size_t>(k)].density - nearest + gap));
    return fit_line(log_distance, log_energy);
  };
  // The gap between φ_J and the nearest state is a scale parameter: search its logarithm.
  const auto cost = [&](double log_gap) { return fit_at(std::exp(log_gap)).squared_residual; };
  const auto [log_gap, unused] = boost::math::tools::brent_find_minima(
      cost, std::log(window * 1e-3), std::log(window * 4), std::numeric_limits<double>::digits / 2);
  return fit_at(std::exp(log_gap)).slope;
}

}  // namespace

std::optional<JammingPoint> fit_jamming_point(std::span<const EnergyPoint> states, double window) {
  std::vector<int> order;
  for (int k = 0; k < static_cast<int>(states.size()); ++k) {
    if (states[static_cast<std::size_t>(k)].energy_per_particle > 0) order.push_back(k);
  }
  if (order.size() < 2) return std::nullopt;
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) {
    return states[static_cast<std::size_t>(p)].density < states[static_cast<std::size_t>(q)].density;
  });
  // φ_J and the states within the window of it fix each other; the number of states can only settle or cycle.
  std::size_t used = 2;
  Line line;
  for (std::size_t round = 0; round <= order.size(); ++round) {
    line = fit_asymptote(states, std::span(order).first(used));
    const auto within = static_cast<std::size_t>(std::count_if(order.begin(), order.end(), [&](int k) {
      return states[static_cast<std::size_t>(k)].density - line.intercept < window;
    }));
    const std::size_t next = std::max<std::size_t>(2, within);
    if (next == used) break;
    used = next;
  }
  const std::span<const int> chosen = std::span(order).first(used);
  line = fit_asymptote(states, chosen);
  const EnergyPoint& nearest = states[static_cast<std::size_t>(order.front())];
  JammingPoint point;
  point.density = line.intercept;
  point.standard_error = std::sqrt(line.intercept_variance);
  if (used > 2) {
    const boost::math::students_t student(static_cast<double>(used - 2));
    point.ci95_half_width = boost::math::quantile(student, 0.975) * point.standard_error;
  }
  point.single_state = nearest.density - 6 * nearest.energy_per_particle / nearest.slope;
  point.exponent = free_exponent(states, chosen, window);
  point.states.assign(chosen.begin(), chosen.end());
  return point;
}

}  // namespace isojam
