#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace isojam {

inline constexpr std::size_t most_planes = 256;  ///< the time is O(n³)

/// The corners of the solid n·x ≤ d for all planes (nx, ny, nz, d). Redundant planes are allowed. A corner in which
/// more than three planes meet can occur several times, up to rounding. Throws ContentError if the solid is empty or
/// not bounded.
std::vector<Eigen::Vector3d> corners_between(std::span<const Eigen::Vector4d> planes);

}  // namespace isojam
