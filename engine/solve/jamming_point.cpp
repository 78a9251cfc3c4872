#include "engine/solve/jamming_point.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/straight_line.hpp"

namespace isojam {

namespace {

double sixth_root(double energy) { return nearest::cbrt(std::sqrt(energy)); }

/// Line of φ as a function of (E/N)^(1/6). Its intercept is φ_J.
Line fit_asymptote(std::span<const EnergyPoint> states, std::span<const int> chosen) {
  std::vector<double> root, density;
  for (const int k : chosen) {
    root.push_back(sixth_root(states[static_cast<std::size_t>(k)].energy_per_particle));
    density.push_back(states[static_cast<std::size_t>(k)].density);
  }
  return fit_line(root, density);
}

/// The exponent x of E ∝ (φ − φ_J)^x, where both x and φ_J are fitted. For each φ_J, x is the slope of a line through
/// the logarithms.
double free_exponent(std::span<const EnergyPoint> states, std::span<const int> chosen, double window) {
  if (chosen.size() < 4) return 0;
  const double nearest = states[static_cast<std::size_t>(chosen.front())].density;
  std::vector<double> log_energy;
  for (const int k : chosen)
    log_energy.push_back(nearest::log(states[static_cast<std::size_t>(k)].energy_per_particle));
  const auto fit_at = [&](double gap) {
    std::vector<double> log_distance;
    for (const int k : chosen)
      log_distance.push_back(nearest::log(states[static_cast<std::size_t>(k)].density - nearest + gap));
    return fit_line(log_distance, log_energy);
  };
  // The gap between φ_J and the nearest state is a scale parameter, so the search is in its logarithm.
  const auto cost = [&](double log_gap) { return fit_at(nearest::exp(log_gap)).squared_residual; };
  const auto [log_gap, unused] = boost::math::tools::brent_find_minima(
      cost, nearest::log(window * 1e-3), nearest::log(window * 4), std::numeric_limits<double>::digits / 2);
  return fit_at(nearest::exp(log_gap)).slope;
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
  // φ_J determines the states within its window, and these determine φ_J. The iteration either converges or cycles.
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
  if (used > 2) point.ci95_half_width = student_95(static_cast<double>(used - 2)) * point.standard_error;
  point.single_state = nearest.density - 6 * nearest.energy_per_particle / nearest.slope;
  point.exponent = free_exponent(states, chosen, window);
  point.states.assign(chosen.begin(), chosen.end());
  return point;
}

}  // namespace isojam
