#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/relax_to_minimum.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

// A packing is collectively jammed if no particles can rearrange in a fixed cell. It is strictly jammed if particles
// cannot rearrange even if the cell shape may change at the same pressure (Torquato, Stillinger 2001; for soft
// particles Smith, Srivastava, Fisher, Alam 2014). In a strictly jammed state, E + p V_cell has a strict minimum with
// respect to particles and all six strains, apart from translations.

/// Computes the second derivatives of the enthalpy with respect to particles and free strains, at the pressure of
/// `control`.
BlockMatrix enthalpy_hessian(const Packing& packing, const CellControl& control, Precision precision);

/// The control of the cell for the test of strict jamming: all strains are free, at the pressure of the packing.
CellControl strict_control(const Evaluation& evaluation);

/// Counts the modes of the Hessian with the border of the six strains. If the stress is not hydrostatic, the state is
/// not an equilibrium with respect to the strains. The numbers then refer to the second derivatives with respect to
/// logarithmic strain.
Stability strict_stability(const Packing& packing, const Evaluation& evaluation, Precision precision);

/// True if a packing is strictly jammed apart from near-rattlers. The criterion is that there is no negative mode, and
/// that the number of zero modes without translations is at most the number of coordinates of the near-rattlers.
bool is_strictly_jammed(const Stability& stability);

/// The strain of the cell with the smallest stiffness, if the particles relax.
struct SoftStrain {
  /// step of particles (6N entries) and strains, in the format of moved(); the strains have unit length
  Eigen::VectorXd step;
  double stiffness = 0;  ///< second derivative of the enthalpy along the step
};
/// Computes the softest strain from a Hessian with the border of the strains. nullopt if the particles are unstable in
/// the fixed cell.
std::optional<SoftStrain> softest_strain(const BlockMatrix& hessian);

/// Result of relaxing the cell shape and volume of an equilibrium at constant pressure.
struct FreedCell {
  MinimumSearchResult result;  ///< result of the search for a minimum with respect to particles and cell together
  double strain = 0;  ///< strain |½ (FᵀF − 1)|, where F is the deformation from the original cell to the new cell
  double density = 0, energy_per_particle = 0, pressure = 0, deviator = 0;  ///< values in the final state
};

/// Relaxes the cell of an equilibrium whose φ − φ_J is about `distance`. The method of multipliers (follow_load) finds
/// an equilibrium. If it is a saddle, it is relaxed along its negative modes.
FreedCell free_cell(const Packing& packing, double distance, const MinimiseOptions& options = {});

}  // namespace isojam
