#pragma once

#include <stop_token>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"
#include "engine/solve/minimise/minimise.hpp"

namespace isojam {

/// From an equilibrium to the one that it becomes at a lower `density`, by multipliers on contacts; how is told in
/// multipliers.cpp. `packing`: in double-double the equilibrium, on return the state reached, an equilibrium of the
/// energy if is_equilibrium(summary) says so. `distance`: its φ − φ_J, more than the strain step.
///
/// Of the options residual, unjammed_energy and max_evaluations hold; the last bounds evaluations of energy and
/// envelope together.
MinimiseSummary follow_equilibrium(Packing& packing, double density, double distance, PackingEnergy& energy,
                                   const MinimiseOptions& options, std::stop_token stop = {});

/// The same to the one that it becomes in its cell deformed by F, a small strain.
MinimiseSummary follow_deformation(Packing& packing, const DoubleDoubleMatrix& f, double distance,
                                   PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop = {});

/// The same to the one that it becomes under the load of options.control, in whose cell the volume is free.
MinimiseSummary follow_load(Packing& packing, double distance, PackingEnergy& energy, const MinimiseOptions& options,
                            std::stop_token stop = {});

/// From a state that is not one, but not far from an equilibrium at the same density, by the same method with
/// multipliers that are 0 at first. `force`, `distance`: guesses of the mean contact force (Y·V_p^(2/3)) and of φ − φ_J
/// there, for scales: within a factor of ten they will do.
MinimiseSummary relax_to_equilibrium(Packing& packing, double force, double distance, PackingEnergy& energy,
                                     const MinimiseOptions& options, std::stop_token stop = {});

}  // namespace isojam
