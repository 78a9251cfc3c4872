#pragma once

#include <optional>
#include <span>
#include <vector>

namespace isojam {

/// A minimised state near jamming; energies in Y·V_p.
struct EnergyPoint {
  double density = 0;              ///< φ
  double energy_per_particle = 0;  ///< E/N
  double slope = 0;                ///< dE/dφ per particle = p/φ²
};

/// φ_J from the asymptote of (E/N)^(1/6), which is linear in φ: E ∝ Δφ⁶ (Smith, Fisher, Alam 2011; their Table I).
struct JammingPoint {
  double density = 0;          ///< φ_J
  double standard_error = 0;   ///< standard error of the fit; 0 with two states
  double ci95_half_width = 0;  ///< from Student's t with the fit's degrees of freedom; 0 with fewer than three states
  double single_state = 0;     ///< φ − 6E/(dE/dφ) of the state nearest to jamming
  double exponent = 0;      ///< x of E ∝ Δφ^x for the same states, with φ_J fitted too; 0 if the fit is impossible
  std::vector<int> states;  ///< indices of the states used, nearest first
};

/// Fits the states with φ − φ_J < window, with φ_J determined self-consistently; uses the two nearest states if fewer
/// are within. nullopt with fewer than two states of positive energy.
std::optional<JammingPoint> fit_jamming_point(std::span<const EnergyPoint> states, double window);

}  // namespace isojam
