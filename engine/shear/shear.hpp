#pragma once

#include <Eigen/Core>
#include <array>
#include <stop_token>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

// Quasi-static shear of a jammed packing: the strain or the stress changes in small steps, and the packing is minimised
// after each step. The strain γ and the shear stress s are conjugate, dE = V_cell s dγ. In the linear regime, s = G γ
// with the shear modulus G. p is the pressure, and σ is the stress.

/// Geometry of the shear.
enum class ShearMode {
  pure,   ///< ε = γ/2 (x̂x̂ − ŷŷ), s = (σ_xx − σ_yy)/2
  simple  ///< x → x + γ y, s = σ_xy
};
template <>
inline constexpr std::array enum_names<ShearMode>{EnumName{ShearMode::pure, "pure"},
                                                  EnumName{ShearMode::simple, "simple"}};

/// Quantity that is prescribed in each step of the shear.
enum class ShearControl {
  strain,  ///< γ is prescribed, at constant volume
  stress   ///< s is prescribed, at constant pressure; all six strains of the cell are free
};
template <>
inline constexpr std::array enum_names<ShearControl>{EnumName{ShearControl::strain, "strain"},
                                                     EnumName{ShearControl::stress, "stress"}};

/// Options of shear().
struct ShearOptions {
  ShearMode mode = ShearMode::pure;             ///< geometry of the shear
  ShearControl control = ShearControl::strain;  ///< prescribed quantity
  /// change of γ in a step; with stress control, change of s/p₀ in a step, where p₀ is the pressure of the initial
  /// packing
  double step = 1e-3;
  double until = 0.02;  ///< final value of γ; with stress control, final value of s/p₀
  bool back = false;    ///< true: from `until`, γ or s/p₀ goes back to 0 in the same steps
  /// Options of the minimisations. Leave `control` at its default, because shear() sets it. For any value of `method`,
  /// the method of multipliers first follows the equilibrium in each step.
  MinimiseOptions minimise;
};

/// An equilibrium under shear. Energies are in units of Y·V_p, stress and pressure in Y.
struct ShearState {
  Packing packing;  ///< packing in equilibrium
  double load = 0;  ///< prescribed γ; with stress control, prescribed s/p₀
  /// strain γ; with stress control, it is computed from the deformation of the cell since the start
  double strain = 0;
  double stress = 0;                                      ///< s
  Eigen::Matrix3d full_stress = Eigen::Matrix3d::Zero();  ///< σ
  double pressure = 0, energy = 0;                        ///< p, and E
  long contacts = 0;                                      ///< number of touching pairs
  /// Work of the shear stress and of the pressure in the step, minus the increase of the energy E. In a rearrangement,
  /// it is positive: the packing loses energy.
  double dissipated = 0;
  /// True if the step is a drop. A step is a drop if it reached a saddle, which was then relaxed to a minimum. It is
  /// also a drop if it dissipated more than the fraction drop_part of the energy.
  bool dropped = false;
  int descents = 0;           ///< number of saddles that were relaxed
  MinimiseSummary summary{};  ///< summary of the last minimisation
};

/// A step is a drop if it dissipates more than this fraction of the energy before the step.
inline constexpr double drop_part = 0.01;

/// Reason for the end of shear().
enum class ShearEnd {
  not_called,
  completed,       ///< all requested steps were made
  no_equilibrium,  ///< the minimisation after a step found no equilibrium
  unjammed,        ///< the packing lost its contact forces
  /// The cell became so small or skew that a particle could touch two images of another particle. One reason is a
  /// prescribed stress above the yield stress.
  cell_limit,
  interrupted
};
template <>
inline constexpr std::array enum_names<ShearEnd>{
    EnumName{ShearEnd::not_called, "not_called"},         EnumName{ShearEnd::completed, "completed"},
    EnumName{ShearEnd::no_equilibrium, "no_equilibrium"}, EnumName{ShearEnd::unjammed, "unjammed"},
    EnumName{ShearEnd::cell_limit, "cell_limit"},         EnumName{ShearEnd::interrupted, "interrupted"}};

/// Result of shear().
struct ShearResult {
  ShearEnd ended = ShearEnd::not_called;  ///< reason for the end
  std::vector<ShearState> states;         ///< equilibria, beginning with the initial packing
};

/// Shears an equilibrium in steps. With strain control, the volume is constant. With stress control, the prescribed
/// stress is −p₀·1 + deviator_with(s), where p₀ is the pressure of the initial packing. Throws std::invalid_argument if
/// the pressure of the packing is not positive. Throws the same exception unless 0 < step ≤ until.
ShearResult shear(const Packing& start, const ShearOptions& options, std::stop_token stop = {});

/// Shear stress s of a stress tensor.
double shear_stress(const Eigen::Matrix3d& stress, ShearMode mode);
/// The traceless symmetric stress tensor with the shear stress s. Its only entries that are not 0 are s at xx and
/// −s at yy for pure shear, and s at xy and yx for simple shear.
Eigen::Matrix3d deviator_with(double shear_stress, ShearMode mode);
/// The deformation F of the cell that produces the strain γ.
DoubleDoubleMatrix shear_deformation(double strain, ShearMode mode);

}  // namespace isojam
