#pragma once

#include <span>
#include <vector>

#include "tasks/chart/families/measuring.hpp"
#include "tasks/chart/families/starts.hpp"
#include "tasks/chart/results/point.hpp"

namespace isojam {

/// Number of modes requested of the solvers of compare_modes().
inline constexpr int modes_compared = 50;

/// The families of a comparison without points: names, errors and notes. Empty for the atlas.
std::vector<ChartFamily> empty_families(Comparison comparison);

// One function for each comparison, which adds points to its families. They stop between points when the time is over;
// the caller notes this in the family.

/// Minimisers from the same starts over a range of tolerances (`equilibrium`, error: residual), and the resulting φ_J,
/// Z and C (`bias`, error: |φ_J − φ_J of the reference|). The reference is equilibria of the default method to 1e-9.
/// Tolerances below one that a method misses are not tried: the same run would end the same way.
void compare_minimisers(std::span<const JammedSolid> jammed, const Measuring& measuring, ChartFamily& equilibrium,
                        ChartFamily& bias);

/// Analytic Hessian against central differences over their step; error: largest difference of an eigenvalue from the
/// analytic ones over the largest. The analytic Hessian is assigned the least of these errors, because no independent
/// reference exists.
void compare_hessians(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family);

/// The lowest modes by shift-invert Lanczos over shifts and subspaces and by Lanczos without inversion, against the
/// dense solver; error: largest relative difference of an eigenvalue.
void compare_modes(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family);

/// Overlaps in working, double-double and quadruple precision and by a plain clip of faces, against arithmetic of 50
/// digits, over classes of contacts; error: of V, and beside it that of S.
void compare_overlaps(const Measuring& measuring, ChartFamily& family);

/// Settings of the protocol against their CPU time; error: distance of the mean φ_J over replicates from that of the
/// first setting.
void compare_protocols(const Measuring& measuring, ChartFamily& family);

/// Costs of a replicate of the default protocol, of one of its equilibria and of an evaluation at several numbers of
/// particles, with the fitted power of N. No errors.
void measure_growth(const Measuring& measuring, ChartFamily& family);

}  // namespace isojam
