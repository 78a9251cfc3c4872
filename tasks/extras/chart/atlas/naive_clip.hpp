#pragma once

#include <Eigen/Core>

#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// The quantities of an overlap that the atlas compares.
struct VolumeAndArea {
  double volume = 0;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();  ///< S_A
};

/// Computes the intersection of A and B by the simplest method in double precision, where r = x_B − x_A. Each face of A
/// and B is clipped by all planes of the other solid. Then V = ⅓ Σ d·area, where the sum is over the remaining parts of
/// faces, and d is the distance of their plane from the centre of A. If faces coincide, the result is wrong without an
/// error message, because such faces may count once, twice or not at all.
VolumeAndArea naive_overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r);

}  // namespace isojam
