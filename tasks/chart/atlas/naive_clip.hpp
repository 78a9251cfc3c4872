#pragma once

#include <Eigen/Core>

#include "engine/geometry/placed_solid.hpp"

namespace isojam {

/// Quantities by which the atlas compares overlap kernels.
struct VolumeAndArea {
  double volume = 0;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();  ///< S_A
};

/// Intersection of A and B, B's centre at r from A's, by the most obvious method: each face of either is clipped by all
/// planes of the other, in doubles, and V = ⅓ Σ d·area over the remaining faces, d a plane's distance from A's centre.
/// The result is false without notice if faces coincide, because they may count once, twice or not at all.
VolumeAndArea naive_overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r);

}  // namespace isojam
