#pragma once

#include <array>
#include <stop_token>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// Method of minimisation. `multipliers` follows an equilibrium through a strain step (solve/multipliers/), which jam()
/// uses near jamming. Without an equilibrium to follow, and in minimise(), it is the same as `newton`. The other
/// methods are for comparison; near jamming they do not converge.
enum class Method { conjugate_gradient, fire, lbfgs, newton, multipliers };
template <>
inline constexpr std::array enum_names<Method>{
    EnumName{Method::conjugate_gradient, "conjugate_gradient"}, EnumName{Method::fire, "fire"},
    EnumName{Method::lbfgs, "lbfgs"}, EnumName{Method::newton, "newton"}, EnumName{Method::multipliers, "multipliers"}};

/// Method of minimisation, and criteria to stop it.
struct MinimiseOptions {
  Method method = Method::multipliers;  ///< minimiser
  /// Residual at which to stop: forces balance to this fraction of the mean contact force.
  double residual = 1e-6;
  /// Energy rule: stop when an iteration changes the energy by less than this fraction; 0 switches the rule off. The
  /// paper uses only this rule, with 1e-12. Near jamming it does not indicate equilibrium, but jam() accepts such
  /// states.
  double energy_change = 0;
  /// Energy per particle (Y·V_p) below which a state whose energy still decreases counts as unjammed. A state with
  /// balanced forces never counts as unjammed, for any energy.
  double unjammed_energy = 1e-20;
  long max_evaluations = 20000;  ///< evaluations of energy and forces in one minimisation
  int history = 20;              ///< number of pairs that L-BFGS stores
  CellControl control{};         ///< fixed cell, or free strains and their load
};

/// Moves `packing` to a local minimum of the energy, or of the enthalpy for a variable cell. On return it is the best
/// state found.
MinimiseSummary minimise(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options,
                         std::stop_token stop = {});

}  // namespace isojam
