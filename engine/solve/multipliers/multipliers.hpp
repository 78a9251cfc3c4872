#pragma once

#include <stop_token>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// Follows an equilibrium to a lower `density`, by the method of multipliers that multipliers.cpp describes. On entry,
/// `packing` must be an equilibrium in double-double. On return, it is the state that was reached; it is an equilibrium
/// of the energy if is_equilibrium(summary) is true. `distance` is φ − φ_J on entry, and must be larger than the strain
/// step.
///
/// The function uses the options residual, unjammed_energy and max_evaluations. The last option limits the sum of the
/// evaluations of the energy and of the envelope.
MinimiseSummary follow_equilibrium(Packing& packing, double density, double distance, PackingEnergy& energy,
                                   const MinimiseOptions& options, std::stop_token stop = {});

/// Follows an equilibrium to the cell that is deformed by F, a small strain.
MinimiseSummary follow_deformation(Packing& packing, const DoubleDoubleMatrix& f, double distance,
                                   PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop = {});

/// Follows an equilibrium to the load of options.control. The volume must be free.
MinimiseSummary follow_load(Packing& packing, double distance, PackingEnergy& energy, const MinimiseOptions& options,
                            std::stop_token stop = {});

/// Relaxes a state that is near an equilibrium at the same density, by the same method with initial multipliers of 0.
/// `force` and `distance` are estimates of the mean contact force (Y·V_p^(2/3)) and of φ − φ_J at the equilibrium. They
/// are used only as scales, so an accuracy of a factor of ten is sufficient.
MinimiseSummary relax_to_equilibrium(Packing& packing, double force, double distance, PackingEnergy& energy,
                                     const MinimiseOptions& options, std::stop_token stop = {});

}  // namespace isojam
