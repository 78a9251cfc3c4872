#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Every reservation that the record of a replicate without failure may hold.
enum class Flag : std::uint8_t {
  crystalline,         ///< Q6 of its contacts is that of a crystal
  not_balanced,        ///< the rule on the energy let states pass whose forces do not balance
  goal_not_reached,    ///< expansion did not come as near to jamming as asked
  outside_fit_window,  ///< φ_J was fitted to states farther from jamming than asked
  not_stable,          ///< some state has other than three zero modes, or a negative one
  classes_undecided,   ///< a fit of the contacts' classes gave no cut-off
  classes_doubtful     ///< one gave a cut-off that its curve does not bear out
};
template <>
inline constexpr std::array enum_names<Flag>{EnumName{Flag::crystalline, "crystalline"},
                                             EnumName{Flag::not_balanced, "not_balanced"},
                                             EnumName{Flag::goal_not_reached, "goal_not_reached"},
                                             EnumName{Flag::outside_fit_window, "outside_fit_window"},
                                             EnumName{Flag::not_stable, "not_stable"},
                                             EnumName{Flag::classes_undecided, "classes_undecided"},
                                             EnumName{Flag::classes_doubtful, "classes_doubtful"}};

/// What means are without unless a manifest says otherwise: they are to be of disordered packings in balance.
inline std::vector<Flag> usually_excluded() { return {Flag::crystalline, Flag::not_balanced}; }

}  // namespace isojam
