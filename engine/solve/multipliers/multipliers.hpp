#pragma once

#include <stop_token>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// Moves an equilibrium to the equilibrium that it becomes at a lower `density`, by the multiplier method that
/// multipliers.cpp describes. On entry `packing` must be an equilibrium in double-double. On return it is the state
/// reached, an equilibrium of the energy if is_equilibrium(summary) is true. `distance` is its φ − φ_J on entry, and
/// must exceed the strain step.
///
/// The options residual, unjammed_energy and max_evaluations apply; the last one limits evaluations of energy and
/// envelope together.
MinimiseSummary follow_equilibrium(Packing& packing, double density, double distance, PackingEnergy& energy,
                                   const MinimiseOptions& options, std::stop_token stop = {});

/// The same, to the equilibrium in the cell deformed by F, a small strain.
MinimiseSummary follow_deformation(Packing& packing, const DoubleDoubleMatrix& f, double distance,
                                   PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop = {});

/// The same, to the equilibrium under the load of options.control, with a free volume.
MinimiseSummary follow_load(Packing& packing, double distance, PackingEnergy& energy, const MinimiseOptions& options,
                            std::stop_token stop = {});

/// Relaxes a state that is near an equilibrium at the same density, by the same method with multipliers that are
/// initially 0. `force` and `distance` are estimates of the mean contact force (Y·V_p^(2/3)) and of φ − φ_J at the
/// equilibrium. They only set scales; an accuracy within a factor of ten is enough.
MinimiseSummary relax_to_equilibrium(Packing& packing, double force, double distance, PackingEnergy& energy,
                                     const MinimiseOptions& options, std::stop_token stop = {});

}  // namespace isojam
