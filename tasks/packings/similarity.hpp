#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// Placement of a solid of unit volume in another frame: y = shift + scale·rotation·x.
struct Similarity {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double scale = 1;
};

/// The similarity that maps the solid to the hull of these points, which are its vertices in any order, to 1e-4 of its
/// size. nullopt if there is none; a mirror image does not count.
std::optional<Similarity> similarity(const ConvexSolid& solid, std::span<const Eigen::Vector3d> points);

}  // namespace isojam
