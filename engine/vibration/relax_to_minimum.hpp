#pragma once

#include <array>
#include <stop_token>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

/// Reason for the end of the search for a minimum.
enum class MinimumSearchEnd {
  not_called,
  was_minimum,      ///< there was no negative mode: the packing is unchanged
  reached_minimum,  ///< a minimum was found after at least one saddle
  lost_balance,     ///< a minimisation found no equilibrium
  still_unstable,   ///< negative modes remain: max_descents is reached, or no lower energy was found along the mode
  undetermined      ///< the stability could not be determined, or no modes were found
};
template <>
inline constexpr std::array enum_names<MinimumSearchEnd>{EnumName{MinimumSearchEnd::not_called, "not_called"},
                                                         EnumName{MinimumSearchEnd::was_minimum, "was_minimum"},
                                                         EnumName{MinimumSearchEnd::reached_minimum, "reached_minimum"},
                                                         EnumName{MinimumSearchEnd::lost_balance, "lost_balance"},
                                                         EnumName{MinimumSearchEnd::still_unstable, "still_unstable"},
                                                         EnumName{MinimumSearchEnd::undetermined, "undetermined"}};

/// Limits and methods of the search for a minimum.
struct MinimumSearchOptions {
  /// largest number of saddles that are relaxed. Relaxing a saddle rarely leads to another saddle; three saddles in
  /// succession were never observed
  int max_descents = 5;
  /// Largest displacement of a particle in the first trial step along the mode, in units of the inradius. It is halved
  /// until the energy decreases.
  double first_step = 0.1;
  MinimiseOptions minimise;         ///< options of the minimisations
  ModeOptions modes{.highest = 1};  ///< only the lowest mode is used; λ_max sets the tolerance
};

/// Result of the search for a minimum.
struct MinimumSearchResult {
  MinimumSearchEnd ended = MinimumSearchEnd::not_called;  ///< reason for the end of the search
  Packing packing;                                        ///< final state
  MinimiseSummary summary{};                              ///< summary of the last minimisation
  Stability stability{};  ///< stability of `packing`; not called if no equilibrium was found last
  int descents = 0;       ///< number of saddles that were relaxed
};

/// Relaxes a saddle to a minimum. The packing is displaced along its lowest mode, in the direction in which the energy
/// decreases more, and minimised. If the result is a saddle again, this is repeated, up to max_descents times. At the
/// beginning the packing is minimised, which does not change an equilibrium. For a variable cell
/// (options.minimise.control), minima and saddles are those of particles and cell together.
MinimumSearchResult relax_to_minimum(const Packing& packing, const MinimumSearchOptions& options = {},
                                     std::stop_token stop = {});

}  // namespace isojam
