#pragma once

#include <optional>
#include <span>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Estimates the distance φ − φ_J of a minimised state as 6E/(dE/dφ), because E ∝ (φ − φ_J)⁶. dE/dφ is N p/φ².
double distance_to_jamming(const JamStep& step);

/// Computes the difference between the equilibria `before` and `after` of the same particles at two densities.
Rearrangement rearrangement(const Packing& before, const JamStep& step_before, const Packing& after,
                            const JamStep& step_after);

/// A step contains a rearrangement if Rearrangement::energy_ratio is below this value. The value is a convention,
/// because the ratio has a continuous distribution. With this value, the number of rearrangements hardly depends on the
/// length of the steps. 12 decompressions of N = 64 particles, from the same initial states for both lengths, had these
/// steps:
///   length of a step   steps   with ratio ≥ 0.95   with ratio < 0.5
///   5 % of Δφ          855     830                 2
///   35 % of Δφ         117     54                  2
/// In a longer step, a packing also becomes softer. This lowers the ratio, although it is not a rearrangement. The two
/// distributions of the ratio therefore differ, but only above about 0.7. 94 more decompressions (N = 32 to 400) had
/// steps of 35 %. They had 483 steps with Δφ below 0.05. The ratio was below 0.5 in 28 of these steps, and in none of
/// the steps with a larger Δφ.
inline constexpr double rearranged_below = 0.5;

/// True if the step contains a rearrangement: its energy_ratio is below rearranged_below, or the solution branch ended
/// in this step.
bool is_rearranged(const JamStep& step);

/// Numbers of steps and rearrangements in a decompression.
struct Rearrangements {
  /// number of steps that led from an equilibrium to the next equilibrium or to the end of a solution branch
  int steps = 0;
  int count = 0;  ///< number of these steps that contain a rearrangement
  /// means over the rearranged steps that led to another equilibrium; nullopt if there is no such step
  std::optional<double> particles_moved, contacts_lost, contacts_gained;
};
/// Counts the rearrangements in the path of a run.
Rearrangements rearrangements(std::span<const JamStep> path);

}  // namespace isojam
