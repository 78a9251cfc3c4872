#pragma once

#include <optional>
#include <span>
#include <vector>

namespace isojam {

/// A minimised state near jamming. Energies are in units of Y·V_p.
struct EnergyPoint {
  double density = 0;              ///< φ
  double energy_per_particle = 0;  ///< E/N
  double slope = 0;                ///< dE/dφ per particle = p/φ²
};

/// Jamming density φ_J from a linear fit. Near jamming E ∝ Δφ⁶, so (E/N)^(1/6) is linear in φ and vanishes at φ_J
/// (Smith, Fisher, Alam 2011, Table I).
struct JammingPoint {
  double density = 0;         ///< φ_J
  double standard_error = 0;  ///< standard error of the fit; 0 with two states
  /// half width of the 95 % confidence interval of the fit (Student t); 0 with fewer than three states
  double ci95_half_width = 0;
  double single_state = 0;  ///< estimate φ − 6E/(dE/dφ) of φ_J from only the state nearest jamming
  /// exponent x of E ∝ Δφ^x, fitted to the same states together with φ_J; 0 if this fit is impossible
  double exponent = 0;
  std::vector<int> states;  ///< indices of the fitted states; the state nearest jamming comes first
};

/// Fits φ_J to the states with φ − φ_J < window. The choice of states depends on φ_J, so both are determined
/// self-consistently. If fewer than two states are in the window, the two states nearest jamming are fitted. Returns
/// nullopt if fewer than two states have a positive energy.
std::optional<JammingPoint> fit_jamming_point(std::span<const EnergyPoint> states, double window);

}  // namespace isojam
