#pragma once

#include "engine/geometry/overlap/contact_loop.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Computes H_AB (OverlapHessian::ab) of a closed loop: the sum of ∫ u_A u_Bᵀ dl / |n_i×n_j| over all segments. u_A and
/// u_B are linear functions on a segment. For a segment d = w − v of length l, the integral is therefore l ū_A ū_Bᵀ +
/// l/12 (0, d×n_i) (0, d×n_j)ᵀ, where ū is the value at the midpoint. Segments of two parallel planes are skipped. The
/// type of r determines the precision with which planes count as parallel.
template <class Solids>
void set_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r,
                       const ContactLoop<Solids>& loop, Matrix6d& h);
template <class Solids>
void set_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                       const ContactLoop<Solids>& loop, Matrix6d& h);

}  // namespace isojam
