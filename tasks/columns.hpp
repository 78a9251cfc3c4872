#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace isojam {

/// A quantity that tables average over replicates.
struct Column {
  enum class Of : std::uint8_t {
    replicate,  ///< one number per replicate; `pointer` is from the record
    state       ///< one per state, also tabulated against Δφ; `pointer` is from the state
  };
  std::string_view name;   ///< key in tables: the paper's symbol
  std::string_view group;  ///< the table it belongs to; that of the first is printed without a title
  Of of;
  std::string_view pointer;  ///< JSON pointer
  std::string_view latex;
};

inline constexpr std::string_view main_group = "jamming";

inline constexpr std::array all_columns{
    Column{"phi_j", main_group, Column::Of::replicate, "/phi_j/phi_j", "\\phi_J"},
    Column{"Z", main_group, Column::Of::state, "/Z", "Z"},
    Column{"Z_ff", main_group, Column::Of::state, "/Z_ff", "Z_{ff}"},
    Column{"Z_ef", main_group, Column::Of::state, "/Z_ef", "Z_{ef}"},
    Column{"Z_l", main_group, Column::Of::state, "/Z_l", "Z_l"},
    Column{"C", main_group, Column::Of::state, "/C", "C"},
};

/// Δφ at which tables give the quantities of a state, interpolated between the states of a replicate linearly in
/// ln Δφ; descending.
inline constexpr std::array series_distances{.16, .08, .04, .02, .01, .005};

}  // namespace isojam
