#pragma once

#include <array>
#include <stop_token>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

/// Reason for the end of relax_to_minimum().
enum class MinimumSearchEnd {
  not_called,
  was_minimum,      ///< the start had no negative mode
  reached_minimum,  ///< a minimum was found after at least one saddle
  lost_balance,     ///< a minimisation found no equilibrium
  /// negative modes remain: `max_descents` is reached, or the energy does not decrease along the mode
  still_unstable,
  /// the zero and negative modes could not be counted, or the lowest mode or the softest strain was not found
  undetermined
};
template <>
inline constexpr std::array enum_names<MinimumSearchEnd>{EnumName{MinimumSearchEnd::not_called, "not_called"},
                                                         EnumName{MinimumSearchEnd::was_minimum, "was_minimum"},
                                                         EnumName{MinimumSearchEnd::reached_minimum, "reached_minimum"},
                                                         EnumName{MinimumSearchEnd::lost_balance, "lost_balance"},
                                                         EnumName{MinimumSearchEnd::still_unstable, "still_unstable"},
                                                         EnumName{MinimumSearchEnd::undetermined, "undetermined"}};

/// Options of relax_to_minimum().
struct MinimumSearchOptions {
  /// Largest number of saddles that are relaxed. A relaxed saddle rarely leads to another saddle; three saddles in
  /// succession were never observed.
  int max_descents = 5;
  /// Largest displacement of a particle in the first trial step along the mode, in units of the inradius. The trial
  /// step is halved until the energy decreases.
  double first_step = 0.1;
  MinimiseOptions minimise;  ///< options of all minimisations
  /// Options for the modes. Only the first of the lowest modes gives a direction; the others help to find
  /// near-rattlers. The highest mode gives λ_max for the tolerance.
  ModeOptions modes{.highest = 1};
};

/// Result of relax_to_minimum().
struct MinimumSearchResult {
  MinimumSearchEnd ended = MinimumSearchEnd::not_called;  ///< reason for the end of the search
  Packing packing;                                        ///< final state
  MinimiseSummary summary{};                              ///< summary of the last minimisation
  /// stability of `packing`; Verdict::not_called if the last minimisation found no equilibrium
  Stability stability{};
  int descents = 0;  ///< number of saddles that were relaxed
};

/// Relaxes a saddle to a minimum. First the packing is minimised, which does not change an equilibrium. If the result
/// is a saddle, it is displaced along its lowest mode, in the direction in which the energy decreases more, and
/// minimised again. This is repeated until a minimum is found, up to `max_descents` times. If the cell is variable
/// (options.minimise.control), the negative modes are those of particles and cell together. If the particles alone have
/// no negative mode, the softest strain (strict.hpp) takes the place of the lowest mode.
MinimumSearchResult relax_to_minimum(const Packing& packing, const MinimumSearchOptions& options = {},
                                     std::stop_token stop = {});

}  // namespace isojam
