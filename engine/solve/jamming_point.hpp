#pragma once

#include <optional>
#include <span>
#include <vector>

namespace isojam {

/// A minimised state on the way to jamming; energies in Y·V_p.
struct EnergyPoint {
  double density = 0;              ///< φ
  double energy_per_particle = 0;  ///< E/N
  double slope = 0;                ///< dE/dφ per particle = p/φ²
};

/// φ_J as the asymptote of (E/N)^(1/6), linear in φ: E ∝ Δφ⁶ (Smith, Fisher, Alam 2011; their Table I).
struct JammingPoint {
  double density = 0;          ///< φ_J
  double standard_error = 0;   ///< of the fit; 0 with two states
  double ci95_half_width = 0;  ///< Student t on the fit's degrees of freedom; 0 with fewer than three states
  double single_state = 0;     ///< φ − 6E/(dE/dφ) of the state nearest jamming
  double exponent = 0;         ///< x of E ∝ Δφ^x, same states, φ_J fitted beside it; 0 if it cannot be fitted
  std::vector<int> states;     ///< indices of the states used, nearest first
};

/// Fits the states with φ − φ_J < window, φ_J found self-consistently; the two nearest where fewer lie within.
/// nullopt with fewer than two states of positive energy.
std::optional<JammingPoint> fit_jamming_point(std::span<const EnergyPoint> states, double window);

}  // namespace isojam
