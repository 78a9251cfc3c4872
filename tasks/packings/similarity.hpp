#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// A similarity transformation from the frame of a solid of unit volume to another frame: y = shift + scale·rotation·x.
struct Similarity {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double scale = 1;
};

/// Finds a similarity that maps the vertices of a solid to these points, which may be in any order. Points may deviate
/// by up to about 1e-4 of the size of the solid. Returns nullopt if there is no such similarity. A reflected solid does
/// not count as similar.
std::optional<Similarity> similarity(const ConvexSolid& solid, std::span<const Eigen::Vector3d> points);

}  // namespace isojam
