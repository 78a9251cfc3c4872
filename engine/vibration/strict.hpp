#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/relax_to_minimum.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

// A packing is collectively jammed if its particles cannot rearrange in a fixed cell. It is strictly jammed if they
// cannot rearrange even if the strain of the cell may change at constant pressure (Torquato, Stillinger 2001; for soft
// particles Smith, Srivastava, Fisher, Alam 2014). In a strictly jammed state, E + p V_cell has a strict minimum with
// respect to particles and all six strains, apart from translations.

/// Computes the second derivatives of the enthalpy with respect to the particles and the free strains of `control`.
BlockMatrix enthalpy_hessian(const Packing& packing, const CellControl& control, Precision precision);

/// Free strains and load for the test of strict jamming: all six strains are free, at the pressure of the packing.
CellControl strict_control(const Evaluation& evaluation);

/// Counts the modes of particles and all six strains together, at the pressure of the packing. If the stress is not
/// hydrostatic, the state is not an equilibrium with respect to the strains. The numbers then refer to the second
/// derivatives with respect to logarithmic strain.
Stability strict_stability(const Packing& packing, const Evaluation& evaluation, Precision precision);

/// True if a packing is strictly jammed apart from near-rattlers: there is no negative mode, and the number of zero
/// modes without translations is at most the number of coordinates of the near-rattlers.
bool is_strictly_jammed(const Stability& stability);

/// The strain of the cell with the smallest stiffness after relaxation of the particles.
struct SoftStrain {
  /// Step (packing.hpp) in which the cell has this strain and the particles relax. Its entries for the strain form a
  /// unit vector.
  Eigen::VectorXd step;
  double stiffness = 0;  ///< second derivative of the enthalpy along the step
};
/// Computes the softest strain from a Hessian with a border for the strains. nullopt if the particles are unstable in a
/// fixed cell.
std::optional<SoftStrain> softest_strain(const BlockMatrix& hessian);

/// Result of free_cell().
struct FreedCell {
  MinimumSearchResult result;  ///< result of relax_to_minimum() for particles and cell together
  double strain = 0;  ///< strain |½ (FᵀF − 1)|, where F is the deformation from the original to the relaxed cell
  /// density φ, E/N, pressure, and deviator_of() in the final state
  double density = 0, energy_per_particle = 0, pressure = 0, deviator = 0;
};

/// Relaxes all six strains of the cell of an equilibrium at constant pressure. `distance` is an estimate of φ − φ_J.
/// The method of multipliers (follow_load()) finds an equilibrium. If this equilibrium is a saddle, it is relaxed to a
/// minimum.
FreedCell free_cell(const Packing& packing, double distance, const MinimiseOptions& options = {});

}  // namespace isojam
