#pragma once

#include <cstdint>
#include <limits>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// A candidate separating axis of two solids, stored as the features that define it, so that it rotates with them.
struct SeparatingAxis {
  /// Features that define the axis: the normal of a face, or the product of two edges.
  enum class Kind : std::uint8_t { none, face_a, face_b, edge_edge };
  Kind kind = Kind::none;  ///< none: no axis is known
  std::uint8_t a = 0;      ///< face of A, or edge of A
  std::uint8_t b = 0;      ///< face of B, or edge of B
};

/// Gap between A and B along the axis (negative: they overlap along it; −infinity for Kind::none).
double gap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, const SeparatingAxis& axis);

/// The axis with the largest gap among all face normals and edge-edge products. By the separating axis theorem two
/// convex polyhedra are disjoint exactly if this gap is positive.
SeparatingAxis best_axis(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

/// The axis with the largest gap between placed solids, with B's centre at r from A's.
SeparatingAxis best_axis(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r);

/// A gap larger than this proves separation despite rounding: a multiple of ulp(|r| + circumradii), r = x_B − x_A.
inline double gap_tolerance(const ConvexSolid& a, const ConvexSolid& b, const Eigen::Vector3d& r) {
  return 4 * std::numeric_limits<double>::epsilon() * (r.lpNorm<1>() + a.circumradius() + b.circumradius());
}
double gap_tolerance(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

/// True if the axis separates the placed solids by more than gap_tolerance, with B's centre at r from A's. False for
/// Kind::none.
bool separates(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, const SeparatingAxis& axis);

}  // namespace isojam
