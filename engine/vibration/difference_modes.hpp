#pragma once

#include <Eigen/Core>

#include "engine/packing/packing.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// All 6N eigenvalues, ascending, of D by central differences with step h (difference_hessian): of what a program
/// without analytic second derivatives takes for D. Translations, null vectors of differences too but for rounding, are
/// projected out: three of the eigenvalues are 0 as nearly as those of D. h in V_p^(1/3), of x and of R·θ. Throws as
/// difference_hessian does.
Eigen::VectorXd difference_modes(const Packing& packing, double h, Precision precision);

}  // namespace isojam
