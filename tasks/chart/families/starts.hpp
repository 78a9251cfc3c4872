#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/chart/families/measuring.hpp"

namespace isojam {

/// A packing jammed once, by Newton's method, from whose expansion the starts of all comparisons are taken.
struct JammedSolid {
  SolidKind solid = SolidKind::octahedron;
  int number = 0;  ///< of the packing
  double phi_j = 0;
  std::vector<Packing> states;  ///< of the expansion, density descending
};

/// Jams as many packings of every solid as the configuration requests and returns those that jammed; fewer after a stop
/// request.
std::vector<JammedSolid> jam_all(const Measuring& measuring);

/// A strain step as the expansion makes it.
struct StrainStart {
  Packing equilibrium;  ///< a state of the expansion
  double distance = 0;  ///< φ − φ_J of it
  double density = 0;   ///< to which it is strained

  /// Strained affinely: not in equilibrium.
  Packing strained() const { return strained_to(equilibrium, density); }
};

/// From a state of the expansion down to φ_J + distance. nullopt if the expansion began nearer to jamming.
std::optional<StrainStart> start_at(const JammedSolid& jammed, double distance);

/// The equilibrium that minimise() finds from there by its default method, to a residual of 1e-9 or to the attainable
/// accuracy; nullopt if it finds none.
std::optional<Packing> equilibrium_at(const JammedSolid& jammed, double distance, const Measuring& measuring);

/// The equilibria of a solid at a distance, of every packing that has one.
struct TaskEquilibria {
  std::string task;
  std::vector<Packing> packings;
};

/// Starts for every solid and distance of the configuration, in this order. After a stop request returns those
/// completed.
std::vector<TaskEquilibria> all_equilibria(std::span<const JammedSolid> jammed, const Measuring& measuring);

/// Dynamical matrix of an equilibrium, as accurate as the state is.
BlockMatrix double_double_hessian(const Packing& packing);

/// "octahedron, Δφ = 0.015"
std::string task_name(SolidKind solid, double distance);

}  // namespace isojam
