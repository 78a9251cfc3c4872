#pragma once

#include <stop_token>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// Follows an equilibrium to a lower density by the method of multipliers, which multipliers.cpp describes. On entry,
/// `packing` must be an equilibrium, with its residual computed in double-double. `distance` is its φ − φ_J, and must
/// be larger than the decrease of the density. On return, `packing` is the state that was reached. It is an equilibrium
/// of the energy if is_equilibrium(summary) is true for the returned summary. The function uses the options `control`,
/// `residual`, `unjammed_energy` and `max_evaluations`. `max_evaluations` limits the number of evaluations of the
/// energy and of the envelope together. The envelope is the function that this method minimises instead of the energy.
/// If this method finds no equilibrium, Newton's method may follow. It makes at most about 500 more evaluations, and
/// also uses the option `energy_change`.
MinimiseSummary follow_equilibrium(Packing& packing, double density, double distance, PackingEnergy& energy,
                                   const MinimiseOptions& options, std::stop_token stop = {});

/// Follows an equilibrium, in the same way as follow_equilibrium(), while its cell is deformed: the new lattice vectors
/// are the columns of f·h, where the columns of h are the old ones. `f` must be close to the identity.
MinimiseSummary follow_deformation(Packing& packing, const DoubleDoubleMatrix& f, double distance,
                                   PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop = {});

/// Follows an equilibrium, in the same way as follow_equilibrium(), until its stress is the stress or pressure that
/// options.control prescribes. The volume must be free.
MinimiseSummary follow_load(Packing& packing, double distance, PackingEnergy& energy, const MinimiseOptions& options,
                            std::stop_token stop = {});

/// Relaxes a state that is near an equilibrium with the same density. The method is the same as in
/// follow_equilibrium(), but the initial multipliers are 0. `force` and `distance` are estimates of the mean contact
/// force (Y·V_p^(2/3)) and of φ − φ_J at the equilibrium. These estimates only set scales, so an error of a factor of
/// ten does not matter.
MinimiseSummary relax_to_equilibrium(Packing& packing, double force, double distance, PackingEnergy& energy,
                                     const MinimiseOptions& options, std::stop_token stop = {});

}  // namespace isojam
