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

// Quasi-static shear of a jammed packing: strain or stress in small steps, with a new equilibrium after each. Strain γ
// and shear stress s are conjugate, dE = V s dγ, so that s = G γ with the shear modulus G where the answer is linear.

/// Which shear.
enum class ShearMode {
  pure,   ///< ε = γ/2 (x̂x̂ − ŷŷ), s = (σ_xx − σ_yy)/2
  simple  ///< x → x + γ y, s = σ_xy
};
template <>
inline constexpr std::array enum_names<ShearMode>{EnumName{ShearMode::pure, "pure"},
                                                  EnumName{ShearMode::simple, "simple"}};

/// What is given in it.
enum class ShearControl {
  strain,  ///< γ is given, the volume kept
  stress   ///< s is given, and the pressure kept: the cell is free
};
template <>
inline constexpr std::array enum_names<ShearControl>{EnumName{ShearControl::strain, "strain"},
                                                     EnumName{ShearControl::stress, "stress"}};

/// How a packing is sheared.
struct ShearOptions {
  ShearMode mode = ShearMode::pure;             ///< which shear
  ShearControl control = ShearControl::strain;  ///< what is given
  double step = 1e-3;        ///< Δγ of a step; under stress control Δs/p, p the pressure at the start
  double until = 0.02;       ///< γ or s/p at which the load turns back or ends
  bool back = false;         ///< whether the load goes back to zero again
  MinimiseOptions minimise;  ///< how equilibria are found
};

/// An equilibrium under shear; energies in Y·V_p, stress and pressure in Y.
struct ShearState {
  Packing packing;    ///< in equilibrium
  double load = 0;    ///< γ or s/p that was asked for
  double strain = 0;  ///< γ; under stress control as the deformation since the start has it
  double stress = 0;  ///< s
  Eigen::Matrix3d full_stress = Eigen::Matrix3d::Zero();  ///< σ
  double pressure = 0, energy = 0;                        ///< p, and E
  long contacts = 0;                                      ///< touching pairs
  /// Work done in the step less what is stored: positive where the packing gave way.
  double dissipated = 0;
  /// Whether it did: the mode that the step was taken along had become unstable, or more than drop_part of the energy
  /// was dissipated.
  bool dropped = false;
  int descents = 0;           ///< saddles that the state was followed down from
  MinimiseSummary summary{};  ///< of the last minimisation
};

/// Part of the energy that a step must dissipate to count as one in which the packing gave way.
inline constexpr double drop_part = 0.01;

/// How a shear ended.
enum class ShearEnd {
  not_called,
  completed,       ///< as far as asked for
  no_equilibrium,  ///< a step led to none: the packing slides farther than is worth following
  unjammed,        ///< it lost its contact forces
  cell_limit,      ///< the cell became too skew or small: under a stress beyond its yield stress it runs away
  interrupted
};
template <>
inline constexpr std::array enum_names<ShearEnd>{
    EnumName{ShearEnd::not_called, "not_called"},         EnumName{ShearEnd::completed, "completed"},
    EnumName{ShearEnd::no_equilibrium, "no_equilibrium"}, EnumName{ShearEnd::unjammed, "unjammed"},
    EnumName{ShearEnd::cell_limit, "cell_limit"},         EnumName{ShearEnd::interrupted, "interrupted"}};

/// What came of a shear.
struct ShearResult {
  ShearEnd ended = ShearEnd::not_called;  ///< why it went no farther
  std::vector<ShearState> states;         ///< the first as it came
};

/// Shears an equilibrium. Under strain control its volume stays; under stress control its pressure, and s is reached by
/// a prescribed deviator of the stress. Throws std::invalid_argument if it bears no pressure, or unless step and until
/// are positive and step is not above until.
ShearResult shear(const Packing& start, const ShearOptions& options, std::stop_token stop = {});

/// s of a stress, and the deviator with that s.
double shear_stress(const Eigen::Matrix3d& stress, ShearMode mode);
/// Traceless and symmetric, nothing else in it.
Eigen::Matrix3d deviator_with(double shear_stress, ShearMode mode);
/// F of a strain γ.
DoubleDoubleMatrix shear_deformation(double strain, ShearMode mode);

}  // namespace isojam
