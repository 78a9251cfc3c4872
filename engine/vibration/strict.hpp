#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/follow_downhill.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

// A packing is collectively jammed if no particles can rearrange in a fixed cell. It is strictly jammed if they cannot
// while the cell shape may change at the same pressure (Torquato, Stillinger 2001; for soft particles Smith,
// Srivastava, Fisher, Alam 2014). Then E + p V_cell has a strict minimum in particles and all six strains, up to
// translations.

/// Second derivatives of the enthalpy with respect to particles and free strains, at the pressure of the control.
BlockMatrix enthalpy_hessian(const Packing& packing, const CellControl& control, Precision precision);

/// The control for testing strict jamming: all strains free, at the packing's own pressure.
CellControl strict_control(const Evaluation& evaluation);

/// Counts modes of the Hessian bordered by the six strains. If the stress is not hydrostatic, the state is no
/// equilibrium in the strains; the count is then that of the second derivatives with respect to logarithmic strain.
Stability strict_stability(const Packing& packing, const Evaluation& evaluation, Precision precision);

/// True if only near-rattlers are free: there is no negative mode, and the zero modes besides translations are at most
/// as many as the near-rattlers' coordinates.
bool is_strictly_jammed(const Stability& stability);

/// The direction with the smallest stiffness among those in which the cell is strained and the particles follow: a step
/// in the form of moved(), with strains of unit length, and its second derivative. nullopt if the particles are
/// unstable in the fixed cell.
struct SoftStrain {
  Eigen::VectorXd step;  ///< 6N entries, followed by the strains
  double stiffness = 0;  ///< second derivative along the step
};
/// The softest such direction of a Hessian bordered by strains.
std::optional<SoftStrain> softest_strain(const BlockMatrix& hessian);

/// Result of relaxing the cell shape and volume of an equilibrium at constant pressure.
struct FreedCell {
  DownhillResult result;  ///< descent of particles and cell together
  double strain = 0;      ///< |½ (FᵀF − 1)|, F from the original cell to the new one
  double density = 0, energy_per_particle = 0, pressure = 0, deviator = 0;  ///< values in the final state
};

/// Relaxes the cell of an equilibrium with φ − φ_J of about `distance`: first to the equilibrium found by the
/// multiplier method (follow_load), then along negative modes if that is a saddle.
FreedCell free_cell(const Packing& packing, double distance, const MinimiseOptions& options = {});

}  // namespace isojam
