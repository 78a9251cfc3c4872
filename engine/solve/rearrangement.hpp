#pragma once

#include <optional>
#include <span>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Estimate 6E/(dE/dφ) of the distance φ − φ_J of a minimised state to jamming, from E ∝ (φ − φ_J)⁶ and dE/dφ = N p/φ².
double distance_to_jamming(const JamStep& step);

/// Computes the difference between two equilibria, `before` and `after`, of the same particles at two densities.
Rearrangement rearrangement(const Packing& before, const JamStep& step_before, const Packing& after,
                            const JamStep& step_after);

/// A step contains a rearrangement if the energy after it is less than this fraction of the energy that is expected on
/// a smooth solution branch. The choice follows from these measurements:
///   855 steps of 5 % of Δφ (12 decompressions, N = 64): 830 had at least 0.95 of that energy, 2 less than half.
///   117 steps of 35 % from the same initial states: 54 had at least 0.95 of that energy, 2 less than half.
/// The sizes of the energy losses have a continuous distribution. The distributions for both step lengths differ only
/// above a fraction of about 0.7, because a longer step also makes a packing softer, which is not a rearrangement. In
/// 94 more decompressions with steps of 35 % (N = 32 to 400), 28 of 483 steps with Δφ below 0.05 had less than half of
/// the expected energy. No step with a larger Δφ had.
inline constexpr double rearranged_below = 0.5;

/// True if the step contains a rearrangement: its energy_ratio is below rearranged_below, or the solution branch ended
/// in it.
bool is_rearranged(const JamStep& step);

/// Numbers of steps and rearrangements in a decompression, including steps in which a solution branch ended.
struct Rearrangements {
  /// number of steps from an equilibrium to the next one, or to the end of a solution branch, without failed steps
  int steps = 0;
  int is_rearranged = 0;  ///< number of these steps that contain a rearrangement
  /// Means over the steps with a rearrangement that led to another equilibrium; nullopt if there is no such step.
  std::optional<double> particles_moved, contacts_lost, contacts_gained;
};
/// Counts the rearrangements in the path of a run.
Rearrangements rearrangements(std::span<const JamStep> path);

}  // namespace isojam
