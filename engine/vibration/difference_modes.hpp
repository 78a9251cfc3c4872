#pragma once

#include <Eigen/Core>

#include "engine/packing/packing.hpp"
#include "engine/packing/pair_loop.hpp"

namespace isojam {

/// All 6N eigenvalues, ascending, of D by central differences with step h (difference_hessian). A program without
/// analytic second derivatives would use these as D. Translations, which are null vectors of differences too except for
/// rounding, are projected out. Three of the eigenvalues are therefore 0, as accurately as those of D. h in V_p^(1/3),
/// for x and for R·θ. Throws like difference_hessian.
Eigen::VectorXd difference_modes(const Packing& packing, double h, Precision precision);

}  // namespace isojam
