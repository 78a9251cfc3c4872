#pragma once

#include <array>
#include <stop_token>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

/// Reason for the end of a descent.
enum class DownhillEnd {
  not_called,
  was_minimum,      ///< there was no negative mode: the packing is unchanged
  reached_minimum,  ///< a minimum was found after at least one saddle
  lost_balance,     ///< a minimisation ended without equilibrium
  still_unstable,   ///< negative modes remain: max_descents is reached, or no lower energy was found along the mode
  undetermined      ///< the stability is undetermined, or there are no modes
};
template <>
inline constexpr std::array enum_names<DownhillEnd>{
    EnumName{DownhillEnd::not_called, "not_called"},           EnumName{DownhillEnd::was_minimum, "was_minimum"},
    EnumName{DownhillEnd::reached_minimum, "reached_minimum"}, EnumName{DownhillEnd::lost_balance, "lost_balance"},
    EnumName{DownhillEnd::still_unstable, "still_unstable"},   EnumName{DownhillEnd::undetermined, "undetermined"}};

/// Limits and methods of a descent.
struct DownhillOptions {
  int max_descents = 5;  ///< a descent rarely ends at another saddle; three in a row were never observed
  /// Largest displacement of a particle in the first trial along the mode, in inradii; halved until the energy
  /// decreases.
  double first_step = 0.1;
  MinimiseOptions minimise;         ///< options of the minimisations
  ModeOptions modes{.highest = 1};  ///< only the lowest mode is used; λ_max sets the tolerance
};

/// Result of a descent.
struct DownhillResult {
  DownhillEnd ended = DownhillEnd::not_called;  ///< reason for its end
  Packing packing;                              ///< final state
  MinimiseSummary summary{};                    ///< summary of the last minimisation
  Stability stability{};                        ///< stability of `packing`; not called if no equilibrium was found last
  int descents = 0;                             ///< number of saddles that were relaxed
};

/// Relaxes an unstable equilibrium along its lowest mode to a minimum, on the side where the energy decreases more.
/// Repeats this if the result is unstable, a few times at most. The initial packing is minimised first; an equilibrium
/// stays unchanged. For a variable cell (options.minimise.control) it is an equilibrium of particles and cell together.
DownhillResult follow_downhill(const Packing& packing, const DownhillOptions& options = {}, std::stop_token stop = {});

}  // namespace isojam
