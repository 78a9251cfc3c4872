#pragma once

#include <cstdint>
#include <limits>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/placed_solid.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

/// A direction along which two solids A and B may be separated. It is stored as the faces or edges (features) that
/// define it, so it remains useful after the solids have moved and rotated.
struct SeparatingAxis {
  /// Type of the features. The axis is the normal of a face of A or B, or the vector product of an edge of A and an
  /// edge of B.
  enum class Kind : std::uint8_t { none, face_a, face_b, edge_edge };
  Kind kind = Kind::none;  ///< none if no axis is known
  std::uint8_t a = 0;      ///< index of the face or edge of A; not used for Kind::face_b
  std::uint8_t b = 0;      ///< index of the face or edge of B; not used for Kind::face_a
};

/// Gap between A and B along the axis. It is negative if the projections of A and B on the axis overlap, and −infinity
/// for Kind::none.
double gap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, const SeparatingAxis& axis);

/// The axis with the largest gap among all face normals and all vector products of an edge of A and an edge of B. By
/// the separating axis theorem, two convex polyhedra are disjoint if and only if this gap is positive.
SeparatingAxis best_axis(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

/// The axis with the largest gap between placed solids, where r = x_B − x_A.
SeparatingAxis best_axis(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r);

/// A computed gap above this value proves that the solids do not touch, because rounding errors of the gap are smaller.
/// It is a multiple of the rounding error of |r| + the circumradii, where r = x_B − x_A.
inline double gap_tolerance(const ConvexSolid& a, const ConvexSolid& b, const Eigen::Vector3d& r) {
  return 4 * std::numeric_limits<double>::epsilon() * (r.lpNorm<1>() + a.circumradius() + b.circumradius());
}
/// The same value for a relative pose.
double gap_tolerance(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose);

/// True if the gap of the placed solids along the axis is larger than gap_tolerance(), where r = x_B − x_A. False for
/// Kind::none.
bool separates(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, const SeparatingAxis& axis);

}  // namespace isojam
