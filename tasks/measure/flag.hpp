#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Warnings in the record of a replicate that did not fail.
enum class Flag : std::uint8_t {
  /// one of two conditions for the nearest state: Q6, computed from all contacts, is above crystalline_q6; or the
  /// orientational order, or the mean alignment of touching particles, is above its limit, see is_aligned()
  crystalline,
  not_balanced,      ///< a state that is not in equilibrium was accepted because of minimiser.energy_change
  goal_not_reached,  ///< the decompression ended farther from jamming than requested
  /// φ_J was fitted to the two nearest states, because fewer than two states are in the fit window
  outside_fit_window,
  not_stable,         ///< a state has a negative mode, or a number of zero modes other than three
  classes_undecided,  ///< a fit of the alignment angles gave no cut-off
  /// a fit gave a doubtful cut-off, because the fitted curve deviates too much from the distribution of angles
  classes_doubtful
};
template <>
inline constexpr std::array enum_names<Flag>{EnumName{Flag::crystalline, "crystalline"},
                                             EnumName{Flag::not_balanced, "not_balanced"},
                                             EnumName{Flag::goal_not_reached, "goal_not_reached"},
                                             EnumName{Flag::outside_fit_window, "outside_fit_window"},
                                             EnumName{Flag::not_stable, "not_stable"},
                                             EnumName{Flag::classes_undecided, "classes_undecided"},
                                             EnumName{Flag::classes_doubtful, "classes_doubtful"}};

/// Flags that exclude a replicate from means by default. Means are for disordered packings in equilibrium.
inline std::vector<Flag> usually_excluded() { return {Flag::crystalline, Flag::not_balanced}; }

}  // namespace isojam
