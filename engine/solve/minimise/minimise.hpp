#pragma once

#include <array>
#include <stop_token>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/summary.hpp"

namespace isojam {

/// Method of minimisation. With `multipliers`, jam() follows an equilibrium through each decompression step near
/// jamming (solve/multipliers/), and finds the first state of a decompression in the same way if compression ended far
/// from equilibrium. In minimise(), `multipliers` is the same as `newton`. `conjugate_gradient`, `fire` and `lbfgs` do
/// not converge near jamming and are available for comparison. Compression always uses `lbfgs`.
enum class Method { conjugate_gradient, fire, lbfgs, newton, multipliers };
template <>
inline constexpr std::array enum_names<Method>{
    EnumName{Method::conjugate_gradient, "conjugate_gradient"}, EnumName{Method::fire, "fire"},
    EnumName{Method::lbfgs, "lbfgs"}, EnumName{Method::newton, "newton"}, EnumName{Method::multipliers, "multipliers"}};

/// Method of minimisation, and criteria to stop it.
struct MinimiseOptions {
  Method method = Method::multipliers;  ///< method of minimisation
  /// Largest residual of an equilibrium: the minimisation stops when Evaluation::residual is at most this value.
  double residual = 1e-6;
  /// Stopping criterion of the paper, with the value 1e-12 there: the minimisation stops when an iteration decreases
  /// the energy by less than this fraction; not used if it is 0. Near jamming, a state that satisfies the criterion is
  /// not necessarily an equilibrium, but jam() accepts it.
  double energy_change = 0;
  /// Energy per particle (Y·V_p) below which a state that is not yet an equilibrium counts as unjammed. An equilibrium
  /// with contacts never counts as unjammed. Not used if the volume is free.
  double unjammed_energy = 1e-20;
  long max_evaluations = 20000;  ///< largest number of evaluations of energy and forces in one minimisation
  CellControl control{};         ///< free strains of the cell and load on the cell; by default the cell is fixed
};

/// Minimises the energy of `packing`, or the enthalpy for a variable cell. On return, `packing` is the best state that
/// was found.
MinimiseSummary minimise(Packing& packing, PackingEnergy& energy, const MinimiseOptions& options,
                         std::stop_token stop = {});

}  // namespace isojam
