#pragma once

#include "engine/geometry/overlap/contact_loop.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Sets `h` to H_AB of a closed loop, OverlapHessian::ab: Σ ∫ u_A u_Bᵀ dl / |n_i×n_j| over its segments. On a segment
/// of length l and direction d both u are linear. The integral is therefore l ū_A ū_Bᵀ + l/12 (0, d×n_i) (0, d×n_j)ᵀ
/// with ū at its midpoint. Segments of parallel planes are skipped. The type of r sets the precision in which planes
/// count as parallel.
void set_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, const ContactLoop& loop,
                       Matrix6d& h);
void set_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, const ContactLoop& loop,
                       Matrix6d& h);

}  // namespace isojam
