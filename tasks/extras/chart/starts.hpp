#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/extras/chart/measuring.hpp"

namespace isojam {

/// A packing that was jammed with Newton's method. The comparisons of minimisers, Hessians and modes start from states
/// of its decompression.
struct JammedSolid {
  SolidKind solid = SolidKind::octahedron;
  int number = 0;  ///< index of the packing, from 0
  double phi_j = 0;
  std::vector<Packing> states;  ///< states of the decompression, in the order of decreasing density
};

/// Jams as many packings of every solid as the configuration requests, and returns those for which φ_J was found. After
/// a stop request, no further packing is added.
std::vector<JammedSolid> jam_all(const Measuring& measuring);

/// A strain step of a decompression.
struct StrainStart {
  Packing equilibrium;  ///< state before the step
  double distance = 0;  ///< φ − φ_J of this state
  double density = 0;   ///< density after the step

  /// The packing after the affine strain, which is not in equilibrium.
  Packing strained() const { return strained_to(equilibrium, density); }
};

/// The strain step to the density φ_J + distance. It starts from the nearest state with φ − φ_J ≥ 1.1·distance; nullopt
/// if there is no such state.
std::optional<StrainStart> start_at(const JammedSolid& jammed, double distance);

/// The equilibrium after the strain step of start_at(). It is found by minimise() with the default method, with a
/// residual of 1e-9 or at the residual floor. nullopt if no equilibrium is found.
std::optional<Packing> equilibrium_at(const JammedSolid& jammed, double distance, const Measuring& measuring);

/// Equilibria of packings of one solid at one distance to jamming. The pair of solid and distance is called a task.
struct TaskEquilibria {
  /// name of the task, see task_name()
  std::string task;
  std::vector<Packing> packings;
};

/// The equilibria for every solid and distance of the configuration, in this order. A packing without an equilibrium at
/// the distance is left out. After a stop request, all further packings are left out.
std::vector<TaskEquilibria> all_equilibria(std::span<const JammedSolid> jammed, const Measuring& measuring);

/// The Hessian of an equilibrium, computed in double-double. For Platonic solids of unit volume, it is equal to the
/// dynamical matrix.
BlockMatrix double_double_hessian(const Packing& packing);

/// Name of a task, such as "octahedron, Δφ = 0.015".
std::string task_name(SolidKind solid, double distance);

}  // namespace isojam
