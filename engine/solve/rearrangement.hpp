#pragma once

#include <optional>
#include <span>

#include "engine/solve/jam.hpp"

namespace isojam {

/// Estimated φ − φ_J of a minimised state, from E ∝ (φ − φ_J)⁶: 6E/(dE/dφ), dE/dφ = N p/φ².
double distance_to_jamming(const JamStep& step);

/// How the equilibrium `after` differs from `before`, in packings of the same particles at two densities.
Rearrangement rearrangement(const Packing& before, const JamStep& step_before, const Packing& after,
                            const JamStep& step_after);

/// A packing gave way in a step that left it less than this share of the energy that a smooth path lets expect. Sizes
/// of events run on continuously, and a longer step softens a packing as well: of 855 steps of 5 % of Δφ (12
/// expansions, N = 64) 830 kept .95 of that energy or more and 2 less than half; of 117 steps of 35 % from the same
/// starts, 54 and 2. Above some .7 the two counts part, since what softening takes over a long step is no event. Of 94
/// more expansions in steps of 35 % (N = 32 to 400) no step farther than .05 from jamming came below half, and 28 of
/// 483 nearer ones did.
inline constexpr double gave_way_below = 0.5;

/// Whether the packing gave way in this step: its energy_ratio is below gave_way_below, or its branch ended in it.
bool gave_way(const JamStep& step);

/// How often a packing gave way in its expansion, on branches that ended too.
struct Rearrangements {
  int steps = 0;     ///< from an equilibrium to the next, or to the end of its branch; those that failed do not count
  int gave_way = 0;  ///< of these, in which the packing gave way
  /// Means over the steps in which it gave way and came to another equilibrium; nullopt if there is none.
  std::optional<double> particles_moved, contacts_lost, contacts_gained;
};
/// Of the path of a run.
Rearrangements rearrangements(std::span<const JamStep> path);

}  // namespace isojam
