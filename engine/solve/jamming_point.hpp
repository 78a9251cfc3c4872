#pragma once

#include <optional>
#include <span>
#include <vector>

namespace isojam {

/// A minimised state near jamming.
struct EnergyPoint {
  double density = 0;              ///< φ
  double energy_per_particle = 0;  ///< E/N, in units of Y·V_p
  double slope = 0;                ///< dE/dφ per particle = p/φ², in units of Y·V_p
};

/// Jamming density φ_J: the intercept of a line for φ as a function of (E/N)^(1/6). Near jamming E ∝ Δφ⁶, so
/// (E/N)^(1/6) is linear in φ and vanishes at φ_J (Smith, Fisher, Alam 2011, Table I).
struct JammingPoint {
  double density = 0;         ///< φ_J
  double standard_error = 0;  ///< standard error of φ_J in the fit; 0 if only two states are fitted
  /// half width of the 95 % confidence interval of the fit (Student t); 0 if only two states are fitted
  double ci95_half_width = 0;
  double single_state = 0;  ///< estimate φ − 6E/(dE/dφ) of φ_J from the state nearest to jamming alone
  /// exponent x of E ∝ Δφ^x, fitted to the same states together with φ_J; 0 if fewer than four states are fitted
  double exponent = 0;
  std::vector<int> states;  ///< indices of the fitted states; the state nearest to jamming comes first
};

/// Fits φ_J to the states with φ − φ_J < window. The choice of states depends on φ_J, and φ_J on the choice of states,
/// so both are determined together. If fewer than two states are in the window, the two states nearest to jamming are
/// fitted. Returns nullopt if fewer than two states have a positive energy.
std::optional<JammingPoint> fit_jamming_point(std::span<const EnergyPoint> states, double window);

}  // namespace isojam
