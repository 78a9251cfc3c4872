#pragma once

#include <optional>
#include <span>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Estimate of φ − φ_J of a minimised state from E ∝ (φ − φ_J)⁶: 6E/(dE/dφ), dE/dφ = N p/φ².
double distance_to_jamming(const JamStep& step);

/// Difference between the equilibria `before` and `after`: packings of the same particles at two densities.
Rearrangement rearrangement(const Packing& before, const JamStep& step_before, const Packing& after,
                            const JamStep& step_after);

/// A step contains a rearrangement if its final energy is less than this fraction of the energy expected on a smooth
/// path. Event sizes are continuous, and a longer step also softens a packing:
///   855 steps of 5 % of Δφ (12 expansions, N = 64): 830 kept at least 0.95 of that energy, 2 less than half.
///   117 steps of 35 % from the same initial states: 54 kept at least 0.95, 2 less than half.
/// The distributions for both step lengths differ only above about 0.7, due to the softening, which is not an event. In
/// 94 more expansions in steps of 35 % (N = 32 to 400), no step farther than 0.05 from jamming kept less than half; 28
/// of 483 nearer steps did.
inline constexpr double gave_way_below = 0.5;

/// True if the step contains a rearrangement: its energy_ratio is below gave_way_below, or its branch ended in it.
bool gave_way(const JamStep& step);

/// Number of rearrangements in an expansion, including those where a branch ended.
struct Rearrangements {
  int steps = 0;     ///< steps from an equilibrium to the next one, or to the end of its branch, without failed steps
  int gave_way = 0;  ///< those with a rearrangement
  /// Means over the steps with a rearrangement that led to another equilibrium; nullopt if there is none.
  std::optional<double> particles_moved, contacts_lost, contacts_gained;
};
/// Rearrangements in the path of a run.
Rearrangements rearrangements(std::span<const JamStep> path);

}  // namespace isojam
