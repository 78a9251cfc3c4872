#pragma once

#include <span>
#include <vector>

#include "tasks/extras/chart/measuring.hpp"
#include "tasks/extras/chart/point.hpp"
#include "tasks/extras/chart/starts.hpp"

namespace isojam {

/// Number of modes that compare_modes() requests of each solver.
inline constexpr int modes_compared = 50;

/// The families of a comparison before any point is measured: their names, errors and notes. Empty for the atlas.
std::vector<ChartFamily> empty_families(Comparison comparison);

// There is one function for each comparison. It adds points to the families of the comparison. It stops between two
// points when the time is over, and the caller marks the family as incomplete.

/// Compares minimisers that begin from the same states, for several tolerances (family `equilibrium`; the error is the
/// residual). Also compares the resulting φ_J, Z and C (family `bias`; the error is |φ_J − φ_J of the reference|). The
/// reference is equilibria of the default method with a residual of 1e-9. If a method does not reach a tolerance,
/// smaller tolerances are not tried, because the same run would end in the same way.
void compare_minimisers(std::span<const JammedSolid> jammed, const Measuring& measuring, ChartFamily& equilibrium,
                        ChartFamily& bias);

/// Compares the analytic Hessian with central differences with several steps. The error is the largest difference
/// between an eigenvalue and the analytic one, divided by the largest eigenvalue. The smallest of these errors is used
/// as the error of the analytic Hessian, because there is no independent reference.
void compare_hessians(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family);

/// Compares the lowest modes by the shift-invert Lanczos method, with several shifts and subspaces, and by the Lanczos
/// method without inversion. The reference is the dense solver. The error is the largest relative difference of an
/// eigenvalue.
void compare_modes(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family);

/// Compares overlaps in double, double-double and quadruple precision, and by simple clipping of faces, for several
/// classes of contacts. The reference is arithmetic with 50 digits. The error is that of V; the points also contain the
/// error of S.
void compare_overlaps(const Measuring& measuring, ChartFamily& family);

/// Compares the CPU time of settings of the protocol. The error is the difference between the mean φ_J over replicates
/// and that of the first setting.
void compare_protocols(const Measuring& measuring, ChartFamily& family);

/// Measures the CPU time of a replicate with the default protocol, of one equilibrium and of one evaluation, for
/// several numbers of particles, and fits a power of N. There are no errors.
void measure_growth(const Measuring& measuring, ChartFamily& family);

}  // namespace isojam
