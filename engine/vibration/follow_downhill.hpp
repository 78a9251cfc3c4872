#pragma once

#include <array>
#include <stop_token>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

/// How the way downhill ended.
enum class DownhillEnd {
  not_called,
  was_minimum,      ///< no negative mode to begin with: the packing is as it came
  reached_minimum,  ///< a minimum was found below a saddle
  lost_balance,     ///< a minimisation ended without equilibrium
  still_unstable,   ///< negative modes left: descents spent, or no lower energy found along the mode
  undetermined      ///< no verdict on stability, or no modes
};
template <>
inline constexpr std::array enum_names<DownhillEnd>{
    EnumName{DownhillEnd::not_called, "not_called"},           EnumName{DownhillEnd::was_minimum, "was_minimum"},
    EnumName{DownhillEnd::reached_minimum, "reached_minimum"}, EnumName{DownhillEnd::lost_balance, "lost_balance"},
    EnumName{DownhillEnd::still_unstable, "still_unstable"},   EnumName{DownhillEnd::undetermined, "undetermined"}};

/// How far it is followed.
struct DownhillOptions {
  int max_descents = 5;  ///< a saddle below a saddle is seldom, three of them are unheard of
  /// Largest displacement of a particle in the first trial along the mode, in inradii; halved until the energy falls.
  double first_step = 0.1;
  MinimiseOptions minimise;         ///< how equilibria on the way are found
  ModeOptions modes{.highest = 1};  ///< only the lowest is followed; λ_max is for the tolerance
};

/// What came of it.
struct DownhillResult {
  DownhillEnd ended = DownhillEnd::not_called;  ///< why it went no farther
  Packing packing;                              ///< where it ended
  MinimiseSummary summary{};                    ///< of the last minimisation
  Stability stability{};                        ///< of `packing`; not called where balance was lost
  int descents = 0;                             ///< saddles left behind
};

/// Follows an unstable equilibrium along its lowest mode, on the side where the energy falls more, to a minimum, and
/// looks again, a few times at most. What comes is minimised first: an equilibrium stays as it is. Where the cell is
/// free, options.minimise.control, it is one of particles and cell together.
DownhillResult follow_downhill(const Packing& packing, const DownhillOptions& options = {}, std::stop_token stop = {});

}  // namespace isojam
