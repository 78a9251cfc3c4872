#pragma once

#include <array>
#include <stop_token>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// Method of minimisation. multipliers follows an equilibrium through a strain step (solve/multipliers/), which jam()
/// does near jamming; where there is none to follow, and wherever minimise() is called, it is newton. The others are
/// there to be compared with: near jamming they do not converge.
enum class Method { conjugate_gradient, fire, lbfgs, newton, multipliers };
template <>
inline constexpr std::array enum_names<Method>{
    EnumName{Method::conjugate_gradient, "conjugate_gradient"}, EnumName{Method::fire, "fire"},
    EnumName{Method::lbfgs, "lbfgs"}, EnumName{Method::newton, "newton"}, EnumName{Method::multipliers, "multipliers"}};

/// How a packing is brought to equilibrium, and when that is given up.
struct MinimiseOptions {
  Method method = Method::multipliers;  ///< which minimiser
  /// Residual at which to stop: forces balance to this fraction of the mean contact force.
  double residual = 1e-6;
  /// Energy rule: stop when an iteration changes the energy by less than this fraction of it; 0 switches the rule off.
  /// The paper uses 1e-12 and nothing else; it is not a sign of equilibrium near jamming. jam() takes such states all
  /// the same.
  double energy_change = 0;
  /// Energy per particle (Y·V_p) below which a state that is still losing energy counts as unjammed. A state with
  /// balanced forces is never called unjammed, however low its energy.
  double unjammed_energy = 1e-20;
  long max_evaluations = 20000;  ///< of energy and forces, in one minimisation
  int history = 20;              ///< pairs that L-BFGS keeps
  CellControl control{};         ///< of the cell: fixed, or free to give way
};

/// Moves `packing` to a local minimum of the energy, or where the cell is free, of the enthalpy. On return it is the
/// best state seen.
MinimiseSummary minimise(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options,
                         std::stop_token stop = {});

}  // namespace isojam
