#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tasks/measure/measure.hpp"

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

inline constexpr std::string_view main_group = "jamming", contact_group = "other cut-offs";

inline constexpr std::array all_columns{
    Column{"phi_j", main_group, Column::Of::replicate, "/phi_j/phi_j", "\\phi_J"},
    Column{"Z", main_group, Column::Of::state, "/Z", "Z"},
    Column{"Z_ff", main_group, Column::Of::state, "/Z_ff", "Z_{ff}"},
    Column{"Z_ef", main_group, Column::Of::state, "/Z_ef", "Z_{ef}"},
    Column{"Z_l", main_group, Column::Of::state, "/Z_l", "Z_l"},
    Column{"C", main_group, Column::Of::state, "/C", "C"},
    Column{"Z_ff_gap", contact_group, Column::Of::state, "/Z_ff_gap", "Z_{ff}^{gap}"},
    Column{"Z_ff_fixed", contact_group, Column::Of::state, "/fixed_cutoffs/Z_ff", "Z_{ff}^{fixed}"},
    Column{"Z_ef_fixed", contact_group, Column::Of::state, "/fixed_cutoffs/Z_ef", "Z_{ef}^{fixed}"},
    Column{"Z_l_fixed", contact_group, Column::Of::state, "/fixed_cutoffs/Z_l", "Z_l^{fixed}"},
    Column{"C_fixed", contact_group, Column::Of::state, "/fixed_cutoffs/C", "C^{fixed}"},
    Column{"Q4", "order", Column::Of::state, "/order/Q4", "Q_4"},
    Column{"Q6", "order", Column::Of::state, "/order/Q6", "Q_6"},
    Column{"local_Q4", "order", Column::Of::state, "/order/local_Q4", "q_4"},
    Column{"local_Q6", "order", Column::Of::state, "/order/local_Q6", "q_6"},
    Column{"S_orientation", "order", Column::Of::state, "/order/S", "S_o"},
    Column{"S", "clusters", Column::Of::state, "/clusters/S", "S"},
    Column{"l_max", "clusters", Column::Of::state, "/clusters/l_max", "l_{max}/L"},
    Column{"D_max", "clusters", Column::Of::state, "/clusters/D", "D_{max}"},
    Column{"percolates", "clusters", Column::Of::state, "/clusters/percolates", "P"},
    Column{"omega_l", "modes", Column::Of::state, "/modes/omega_l", "\\langle\\omega_l\\rangle"},
    Column{"omega_h", "modes", Column::Of::state, "/modes/omega_h", "\\langle\\omega_h\\rangle"},
    Column{"zero_modes", "modes", Column::Of::state, "/modes/zero", "n_0"},
    Column{"negative_modes", "modes", Column::Of::state, "/modes/negative", "n_-"},
    Column{"p_l", "modes", Column::Of::state, "/modes/lowest/participation", "p_l"},
    Column{"p_h", "modes", Column::Of::state, "/modes/highest/participation", "p_h"},
    Column{"face_face_amplitude", "modes", Column::Of::state, "/modes/face_face_amplitude", "a_{ff}"},
    Column{"face_face_particles", "modes", Column::Of::state, "/modes/face_face_particles", "n_{ff}"},
    Column{"K", "moduli", Column::Of::state, "/moduli/K", "K"},
    Column{"G", "moduli", Column::Of::state, "/moduli/G", "G"},
    Column{"G_min", "moduli", Column::Of::state, "/moduli/G_min", "G_{min}"},
    Column{"x_omega_l", "exponents", Column::Of::replicate, "/mode_scaling/omega_l/exponent", "x_{\\omega_l}"},
    Column{"x_omega_h", "exponents", Column::Of::replicate, "/mode_scaling/omega_h/exponent", "x_{\\omega_h}"},
    Column{"x_E", "exponents", Column::Of::replicate, "/moduli_scaling/E/exponent", "x_E"},
    Column{"x_p", "exponents", Column::Of::replicate, "/moduli_scaling/p/exponent", "x_p"},
    Column{"x_K", "exponents", Column::Of::replicate, "/moduli_scaling/K/exponent", "x_K"},
    Column{"self_stress_normals", "rigidity", Column::Of::state, "/rigidity/normals/self_stress", "s_n"},
    Column{"self_stress_classes", "rigidity", Column::Of::state, "/rigidity/classes/self_stress", "s_c"},
    Column{"floppy_normals", "rigidity", Column::Of::state, "/rigidity/normals/floppy", "f_n"},
    Column{"floppy_classes", "rigidity", Column::Of::state, "/rigidity/classes/floppy", "f_c"},
};

/// The measure that gives a column; nullopt for φ_J, which every replicate has.
std::optional<Measure> measure_of(const Column& column);

/// Δφ at which tables give the quantities of a state, interpolated between the states of a replicate linearly in
/// ln Δφ; descending.
inline constexpr std::array series_distances{.16, .08, .04, .02, .01, .005};

}  // namespace isojam
