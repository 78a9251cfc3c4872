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

// Quasi-static shear of a jammed packing: strain or stress changes in small steps, and the packing is brought to
// equilibrium after each step. The strain γ and the shear stress s are conjugate, dE = V s dγ. In the linear regime, s
// = G γ with the shear modulus G.

/// Kind of shear.
enum class ShearMode {
  pure,   ///< ε = γ/2 (x̂x̂ − ŷŷ), s = (σ_xx − σ_yy)/2
  simple  ///< x → x + γ y, s = σ_xy
};
template <>
inline constexpr std::array enum_names<ShearMode>{EnumName{ShearMode::pure, "pure"},
                                                  EnumName{ShearMode::simple, "simple"}};

/// Quantity that is prescribed.
enum class ShearControl {
  strain,  ///< γ is prescribed, at constant volume
  stress   ///< s is prescribed, at constant pressure and with a free cell
};
template <>
inline constexpr std::array enum_names<ShearControl>{EnumName{ShearControl::strain, "strain"},
                                                     EnumName{ShearControl::stress, "stress"}};

/// Parameters of a shear.
struct ShearOptions {
  ShearMode mode = ShearMode::pure;             ///< kind of shear
  ShearControl control = ShearControl::strain;  ///< prescribed quantity
  double step = 1e-3;   ///< change of γ in a step; with stress control, change of s/p, where p is the initial pressure
  double until = 0.02;  ///< final value of γ, or of s/p with stress control
  bool back = false;    ///< true if the load is then reduced to zero again
  MinimiseOptions minimise;  ///< options of the minimisations
};

/// An equilibrium under shear. Energies are in units of Y·V_p, stress and pressure in Y.
struct ShearState {
  Packing packing;    ///< packing in equilibrium
  double load = 0;    ///< prescribed γ or s/p
  double strain = 0;  ///< strain γ; with stress control it is computed from the deformation since the start
  double stress = 0;  ///< s
  Eigen::Matrix3d full_stress = Eigen::Matrix3d::Zero();  ///< σ
  double pressure = 0, energy = 0;                        ///< p, and E
  long contacts = 0;                                      ///< number of touching pairs
  /// Work of the shear in the step minus the increase of the energy. It is positive for a rearrangement.
  double dissipated = 0;
  /// True if the step contains a rearrangement: the equilibrium was a saddle and had to be relaxed along a negative
  /// mode, or the step dissipated more than drop_part of the energy.
  bool dropped = false;
  int descents = 0;           ///< number of saddles that were relaxed
  MinimiseSummary summary{};  ///< summary of the last minimisation
};

/// Fraction of the energy that a step must dissipate to count as a rearrangement.
inline constexpr double drop_part = 0.01;

/// Reason for the end of a shear.
enum class ShearEnd {
  not_called,
  completed,       ///< the requested load was reached
  no_equilibrium,  ///< a step found no equilibrium, because the packing slides too far
  unjammed,        ///< the packing lost its contact forces
  cell_limit,      ///< the cell became too skew or small; this happens if the stress exceeds the yield stress
  interrupted
};
template <>
inline constexpr std::array enum_names<ShearEnd>{
    EnumName{ShearEnd::not_called, "not_called"},         EnumName{ShearEnd::completed, "completed"},
    EnumName{ShearEnd::no_equilibrium, "no_equilibrium"}, EnumName{ShearEnd::unjammed, "unjammed"},
    EnumName{ShearEnd::cell_limit, "cell_limit"},         EnumName{ShearEnd::interrupted, "interrupted"}};

/// Result of a shear.
struct ShearResult {
  ShearEnd ended = ShearEnd::not_called;  ///< reason for its end
  std::vector<ShearState> states;         ///< equilibria, beginning with the initial packing
};

/// Shears an equilibrium. With strain control the volume is constant. With stress control the pressure is constant, and
/// a stress deviator with the shear stress s is prescribed. Throws std::invalid_argument if the packing has no
/// pressure, or unless `step` and `until` are positive and `step` is at most `until`.
ShearResult shear(const Packing& start, const ShearOptions& options, std::stop_token stop = {});

/// Shear stress s of a stress tensor.
double shear_stress(const Eigen::Matrix3d& stress, ShearMode mode);
/// The traceless symmetric stress tensor that has only this shear stress.
Eigen::Matrix3d deviator_with(double shear_stress, ShearMode mode);
/// The deformation F of the cell for a strain γ.
DoubleDoubleMatrix shear_deformation(double strain, ShearMode mode);

}  // namespace isojam
