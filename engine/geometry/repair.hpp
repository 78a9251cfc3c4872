#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/hull.hpp"

namespace isojam {

/// Upper limit of RepairOptions::merge.
inline constexpr double largest_merge = 0.01;
/// Largest number of corners of a hull before its repair. The search for the diameter visits all pairs.
inline constexpr int most_hull_corners = 12000;
/// Two adjacent faces whose normals differ by less than this angle (rad) are probably one face whose corners have
/// rounding errors.
inline constexpr double suspect_angle = 1e-3;

/// The repairs that a caller allows. By default none is allowed.
struct RepairOptions {
  /// Length within which points are welded and faces are joined, relative to the diameter of the points. Each point is
  /// welded to the first remaining point that is at most this far away. Adjacent faces are joined if all of their
  /// corners are within this distance of one plane. No corner of the hull is then farther from the result than five
  /// times this length, or 5e-9.
  double merge = 0;
  /// Omits points that are not corners of the convex hull. If false, such a point is an error, unless it is within
  /// `merge` of a face.
  bool hull = false;
  /// Removes corners until this number is left. The value 0 keeps all corners; otherwise at least 4 must be left.
  int corners = 0;
  double max_volume_change = 0.01;  ///< largest relative change of the volume
  bool measures_depth = true;       ///< computes RepairReport::largest_depth, which takes a time of O(n²)
};

/// The repairs that were made.
struct RepairReport {
  int welded = 0;           ///< number of points that were welded to another point
  int dropped = 0;          ///< number of points that were not corners of the hull
  int joined_faces = 0;     ///< number of faces of the hull that became a part of a larger face
  int removed_corners = 0;  ///< number of corners that were removed to reach RepairOptions::corners
  /// Upper bound for the moves of corners, relative to the diameter: the largest move by welding plus the largest by
  /// joining, or the largest distance of a corner that was omitted from the result.
  double largest_move = 0;
  double hull_volume = 0;    ///< volume of the hull of all points, in their unit of length
  double volume_change = 0;  ///< volume of the result divided by hull_volume, minus 1
  /// Largest distance of an omitted point from the surface of the hull, relative to the diameter.
  double largest_depth = 0;
};

/// The corners of a repaired solid.
struct RepairedSolid {
  /// The corners. If nothing was repaired these are the given points. If points were only welded, omitted or removed,
  /// they have the coordinates of given points. If faces were joined, the origin is the centre of the bounding box of
  /// the corners; the unit of length is that of the given points. The corners determine the solid completely:
  /// ConvexSolid needs no data about its faces.
  std::vector<Eigen::Vector3d> vertices;
  RepairReport report;  ///< the repairs that were made
};

/// Repairs the convex hull of points: omits inner points, welds points, removes corners and joins faces, as far as
/// `options` allows it. Points that are no longer corners are then omitted too. Throws NoSolid (hull.hpp) if the points
/// span no volume, if a point is not a corner and options.hull is false, if the repairs move corners or change the
/// volume by more than `options` allows, if joined faces cannot be made planar by moves of the order of options.merge,
/// or if the hull or the result has too many features. NoSolid::vertex() is an index of `points`.
RepairedSolid repaired(std::span<const Eigen::Vector3d> points, const RepairOptions& options);

/// The smallest change of `options` with which repaired() accepts the points that it refused for `cause`. nullopt if no
/// such change was found.
std::optional<RepairOptions> tried_repair(std::span<const Eigen::Vector3d> points, const RepairOptions& options,
                                          NoSolid::Cause cause);

/// Properties of a solid that show whether its vertices were written with enough digits.
struct SolidShape {
  int faces = 0, edges = 0, vertices = 0;  ///< numbers of features
  double volume = 0;                       ///< volume in the units of the given vertices
  /// Largest distance of a given vertex from the plane through its face, relative to the diameter, before the faces are
  /// made exactly planar.
  double largest_distance = 0;
  /// Distance within which vertices were taken to be in one plane, relative to the diameter. It grows with the distance
  /// of the solid from the origin.
  double tolerance = 0;
  double smallest_angle = 0;  ///< smallest angle between the normals of two adjacent faces, in rad
  /// The two adjacent faces with the smallest angle, as indices of ConvexSolid::faces().
  std::array<int, 2> angle_faces{};
  /// A value of RepairOptions::merge that joins all adjacent faces whose normals differ by less than suspect_angle. 0
  /// if there are no such faces, or if no value up to largest_merge joins them.
  double suggested_merge = 0;
};

/// Computes the properties of a solid.
SolidShape shape_of(const ConvexSolid& solid);

}  // namespace isojam
