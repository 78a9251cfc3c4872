#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/extras/chart/measuring.hpp"

namespace isojam {

/// A packing that was jammed with Newton's method. All comparisons begin from states of its decompression.
struct JammedSolid {
  SolidKind solid = SolidKind::octahedron;
  int number = 0;  ///< number of the packing
  double phi_j = 0;
  std::vector<Packing> states;  ///< states of the decompression, in the order of descending density
};

/// Jams as many packings of every solid as the configuration requests, and returns the packings that jammed. After a
/// stop request there are fewer.
std::vector<JammedSolid> jam_all(const Measuring& measuring);

/// A strain step as in a decompression.
struct StrainStart {
  Packing equilibrium;  ///< equilibrium before the step, a state of the decompression
  double distance = 0;  ///< φ − φ_J of this equilibrium
  double density = 0;   ///< density after the step

  /// The packing after the affine strain, which is not in equilibrium.
  Packing strained() const { return strained_to(equilibrium, density); }
};

/// The strain step from a state of the decompression to the density φ_J + distance. nullopt if the decompression began
/// at a smaller distance.
std::optional<StrainStart> start_at(const JammedSolid& jammed, double distance);

/// The equilibrium that minimise() finds after this strain step by the default method, with a residual of 1e-9 or as
/// small as possible. nullopt if it finds none.
std::optional<Packing> equilibrium_at(const JammedSolid& jammed, double distance, const Measuring& measuring);

/// The equilibria of a solid at a distance to jamming, of every packing that has one.
struct TaskEquilibria {
  std::string task;
  std::vector<Packing> packings;
};

/// The equilibria for every solid and distance of the configuration, in this order. After a stop request, returns those
/// that are complete.
std::vector<TaskEquilibria> all_equilibria(std::span<const JammedSolid> jammed, const Measuring& measuring);

/// The dynamical matrix of an equilibrium, computed in double-double.
BlockMatrix double_double_hessian(const Packing& packing);

/// "octahedron, Δφ = 0.015"
std::string task_name(SolidKind solid, double distance);

}  // namespace isojam
