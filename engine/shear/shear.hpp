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

/// Kind of shear.
enum class ShearMode {
  pure,   ///< ε = γ/2 (x̂x̂ − ŷŷ), s = (σ_xx − σ_yy)/2
  simple  ///< x → x + γ y, s = σ_xy
};
template <>
inline constexpr std::array enum_names<ShearMode>{EnumName{ShearMode::pure, "pure"},
                                                  EnumName{ShearMode::simple, "simple"}};

/// Quantity that is prescribed in a shear.
enum class ShearControl {
  strain,  ///< γ is prescribed, at constant volume
  stress   ///< s is prescribed, at constant pressure; all strains are free
};
template <>
inline constexpr std::array enum_names<ShearControl>{EnumName{ShearControl::strain, "strain"},
                                                     EnumName{ShearControl::stress, "stress"}};

/// Options of shear().
struct ShearOptions {
  ShearMode mode = ShearMode::pure;             ///< kind of shear
  ShearControl control = ShearControl::strain;  ///< prescribed quantity
  /// change of γ in a step; with stress control, change of s/p₀, where p₀ is the initial pressure
  double step = 1e-3;
  double until = 0.02;       ///< final value of γ; with stress control, final value of s/p₀
  bool back = false;         ///< true if γ or s then returns to zero in the same steps
  MinimiseOptions minimise;  ///< options of the minimisations
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
  /// Work of the shear stress and of the pressure in the step, minus the increase of the energy E. It is positive if
  /// the packing loses energy in a rearrangement.
  double dissipated = 0;
  /// True if the step is a drop: the equilibrium that it reached was a saddle, which was relaxed to a minimum, or the
  /// step dissipated more than the fraction drop_part of the energy.
  bool dropped = false;
  int descents = 0;           ///< number of saddles that were relaxed
  MinimiseSummary summary{};  ///< summary of the last minimisation
};

/// Fraction of the energy that a step must dissipate to count as a drop.
inline constexpr double drop_part = 0.01;

/// Reason for the end of shear().
enum class ShearEnd {
  not_called,
  completed,       ///< all requested steps were made
  no_equilibrium,  ///< a step found no equilibrium, for example because the packing slides too far
  unjammed,        ///< the packing lost its contact forces
  cell_limit,      ///< the cell became too skew or too small; this happens if the stress exceeds the yield stress
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

/// Shears an equilibrium. With strain control, the volume is constant. With stress control, the pressure is constant,
/// and the prescribed stress has the shear stress s. Throws std::invalid_argument in two cases: the pressure of the
/// packing is not positive, or 0 < step ≤ until is not satisfied.
ShearResult shear(const Packing& start, const ShearOptions& options, std::stop_token stop = {});

/// Shear stress s of a stress tensor.
double shear_stress(const Eigen::Matrix3d& stress, ShearMode mode);
/// The traceless symmetric stress tensor that has only this shear stress.
Eigen::Matrix3d deviator_with(double shear_stress, ShearMode mode);
/// The deformation F of the cell for a strain γ.
DoubleDoubleMatrix shear_deformation(double strain, ShearMode mode);

}  // namespace isojam
