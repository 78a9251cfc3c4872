#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/packing/enthalpy.hpp"
#include "engine/solve/minimise/minimise.hpp"
#include "engine/vibration/follow_downhill.hpp"
#include "engine/vibration/stability.hpp"

namespace isojam {

// A packing is collectively jammed if nothing can give way in a cell that is held, strictly jammed if nothing can while
// the cell is free to change its shape at the same pressure (Torquato, Stillinger 2001; for soft particles Smith,
// Srivastava, Fisher, Alam 2014): if E + p V_cell has a strict minimum in particles and all six strains, up to
// translations.

/// Second derivatives of the enthalpy at the packing's own pressure, or at that of the control, by particles and by the
/// strains that are free.
BlockMatrix enthalpy_hessian(const Packing& packing, const CellControl& control, Precision precision);

/// The control under which a packing is tested for strict jamming: all strains free, its own pressure.
CellControl strict_control(const Evaluation& evaluation);

/// Counts modes of the Hessian bordered by the six strains. The state need not be one of hydrostatic stress: then it is
/// no equilibrium in the strains, and the count is that of the second derivatives by logarithmic strain.
Stability strict_stability(const Packing& packing, const Evaluation& evaluation, Precision precision);

/// Whether nothing gives way but near-rattlers: no negative mode, and no more zero modes beside the translations than
/// these have coordinates.
bool is_strictly_jammed(const Stability& stability);

/// The direction of least stiffness among those in which the cell gives way and particles follow: a step as moved()
/// takes it, with strains of unit length, and its second derivative. nullopt if particles alone give way.
struct SoftStrain {
  Eigen::VectorXd step;  ///< 6N, and strains behind
  double stiffness = 0;  ///< second derivative along it
};
/// The softest such direction of a Hessian bordered by strains.
std::optional<SoftStrain> softest_strain(const BlockMatrix& hessian);

/// What becomes of an equilibrium when its cell is freed at the pressure that it has.
struct FreedCell {
  DownhillResult result;  ///< of particles and cell together
  double strain = 0;      ///< |½ (FᵀF − 1)|, F from the cell that it was in to the one that it is in
  double density = 0, energy_per_particle = 0, pressure = 0, deviator = 0;  ///< of the state that it came to rest in
};

/// Frees the cell of an equilibrium whose φ − φ_J is about `distance`: first to the equilibrium that the multiplier
/// method finds (follow_load), then downhill from saddles.
FreedCell free_cell(const Packing& packing, double distance, const MinimiseOptions& options = {});

}  // namespace isojam
