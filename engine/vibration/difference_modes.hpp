#pragma once

#include <Eigen/Core>

#include "engine/packing/packing.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// Computes all 6N eigenvalues, in ascending order, of the matrix D from central differences (difference_hessian). This
/// is the result that a program without analytic second derivatives would obtain. h is the step of x and of R·θ, in
/// units of V_p^(1/3). Translations are null vectors of this matrix except for rounding errors; they are excluded by
/// projection. Three of the eigenvalues are therefore 0 with the same accuracy as for the analytic D. Throws the same
/// exceptions as difference_hessian().
Eigen::VectorXd difference_modes(const Packing& packing, double h, Precision precision);

}  // namespace isojam
