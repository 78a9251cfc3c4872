#pragma once

#include <Eigen/Core>

#include "engine/packing/packing.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Computes all 6N eigenvalues of the dynamical matrix D from the difference_hessian(), in ascending order. A program
/// without analytic second derivatives would obtain this result. h is the step of x and of R·θ, in units of V_p^(1/3).
/// Rounding errors of the differences would give the translations small nonzero eigenvalues. The translations are
/// therefore removed by projection. Three eigenvalues are then 0 within rounding errors, as for the analytic D. Throws
/// std::invalid_argument unless h > 0.
Eigen::VectorXd difference_modes(const Packing& packing, double h, Precision precision);

}  // namespace isojam
