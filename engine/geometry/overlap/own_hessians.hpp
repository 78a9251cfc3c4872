#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"

namespace isojam {

/// Computes the blocks aa and bb from ab, S and r = x_B − x_A with the formulae of OverlapHessian.
void set_own_hessians(const Eigen::Vector3d& area, const Eigen::Vector3d& r, OverlapHessian& hessian);

}  // namespace isojam
