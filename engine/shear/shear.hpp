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

// Quasi-static shear of a jammed packing: strain or stress changes in small steps, with a new equilibrium after each.
// Strain γ and shear stress s are conjugate, dE = V s dγ, so that s = G γ with the shear modulus G in the linear
// regime.

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
  double step = 1e-3;                           ///< Δγ of a step; with stress control Δs/p, p the initial pressure
  double until = 0.02;                          ///< γ or s/p at which the load is reversed or ends
  bool back = false;                            ///< true if the load returns to zero
  MinimiseOptions minimise;                     ///< options of the minimisations
};

/// An equilibrium under shear; energies in Y·V_p, stress and pressure in Y.
struct ShearState {
  Packing packing;    ///< in equilibrium
  double load = 0;    ///< prescribed γ or s/p
  double strain = 0;  ///< γ; with stress control from the deformation since the start
  double stress = 0;  ///< s
  Eigen::Matrix3d full_stress = Eigen::Matrix3d::Zero();  ///< σ
  double pressure = 0, energy = 0;                        ///< p, and E
  long contacts = 0;                                      ///< touching pairs
  /// Work done in the step minus the increase of stored energy: positive for a rearrangement.
  double dissipated = 0;
  /// True for a rearrangement: the state had to be relaxed along a negative mode, or more than drop_part of the energy
  /// was dissipated.
  bool dropped = false;
  int descents = 0;           ///< number of saddles that were relaxed
  MinimiseSummary summary{};  ///< summary of the last minimisation
};

/// Fraction of the energy that a step must dissipate to count as a rearrangement.
inline constexpr double drop_part = 0.01;

/// Reason for the end of a shear.
enum class ShearEnd {
  not_called,
  completed,       ///< reached the requested load
  no_equilibrium,  ///< a step found no equilibrium: the packing slides too far
  unjammed,        ///< the packing lost its contact forces
  cell_limit,      ///< the cell became too skew or small, as happens for a stress beyond the yield stress
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
  std::vector<ShearState> states;         ///< equilibria; the first one is the initial packing
};

/// Shears an equilibrium. With strain control the volume is constant. With stress control the pressure is constant, and
/// s is reached by a prescribed stress deviator. Throws std::invalid_argument if the packing has no pressure, or unless
/// step and until are positive and step is at most until.
ShearResult shear(const Packing& start, const ShearOptions& options, std::stop_token stop = {});

/// Shear stress s of a stress tensor.
double shear_stress(const Eigen::Matrix3d& stress, ShearMode mode);
/// The traceless symmetric tensor with this s and no other component.
Eigen::Matrix3d deviator_with(double shear_stress, ShearMode mode);
/// Deformation F of a strain γ.
DoubleDoubleMatrix shear_deformation(double strain, ShearMode mode);

}  // namespace isojam
