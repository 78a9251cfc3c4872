#pragma once

#include <span>
#include <vector>

#include "tasks/extras/chart/measuring.hpp"
#include "tasks/extras/chart/point.hpp"
#include "tasks/extras/chart/starts.hpp"

namespace isojam {

/// Number of modes that compare_modes() computes with each solver.
inline constexpr int modes_compared = 50;

/// The families of a comparison, with names, definitions of the errors and notes, but without points. Empty for the
/// atlas.
std::vector<ChartFamily> empty_families(Comparison comparison);

// Each comparison except the atlas has one function, which adds points to the families of the comparison. After the
// time limit it stops before the next point, and the caller marks the family as incomplete.

/// Compares minimisers that start from the same states, for several tolerances. In the family `equilibrium`, the error
/// is the residual. In the family `bias`, the error is |φ_J − φ_J of the reference|. The reference has a residual of
/// 1e-9. For the method `multipliers` it is found by `multipliers`, and for all other methods by `newton`. Two
/// references are needed, because these two methods may follow different solution branches. If a method does not reach
/// a tolerance, smaller tolerances are not tried, because the method would end in the same state.
void compare_minimisers(std::span<const JammedSolid> jammed, const Measuring& measuring, ChartFamily& equilibrium,
                        ChartFamily& bias);

/// Compares the analytic Hessian with central differences for several steps. The error of central differences is the
/// largest relative deviation of an eigenvalue from that of the analytic Hessian. There is no independent reference for
/// the analytic Hessian, so its error is the bound on the rounding errors of its eigenvalues.
void compare_hessians(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family);

/// Compares methods for the lowest modes: the shift-invert Lanczos method with several shifts and dimensions of the
/// Krylov space, and the Lanczos method without inversion. The reference is the dense solver. The error is the largest
/// relative error of an eigenvalue.
void compare_modes(std::span<const TaskEquilibria> tasks, const Measuring& measuring, ChartFamily& family);

/// Compares methods for overlaps, for several classes of pairs: the contact loop in double and in double-double (see
/// overlap.hpp), clipping in quadruple precision, and simple clipping in double. The reference has 50 digits. The error
/// is the relative error of V. Points of methods that compute S also contain its error.
void compare_overlaps(const Measuring& measuring, ChartFamily& family);

}  // namespace isojam
