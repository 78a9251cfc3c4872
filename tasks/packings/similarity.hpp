#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// Similarity transformation of a solid of unit volume to another frame: y = shift + scale·rotation·x.
struct Similarity {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double scale = 1;
};

/// Finds the similarity that maps the vertices of a solid to these points, which may be in any order, with an error of
/// at most 1e-4 of the size of the solid. nullopt if there is none. Reflections are not allowed.
std::optional<Similarity> similarity(const ConvexSolid& solid, std::span<const Eigen::Vector3d> points);

}  // namespace isojam
