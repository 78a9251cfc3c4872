#pragma once

#include <vector>

#include "engine/geometry/repair.hpp"
#include "tasks/packings/content_error.hpp"
#include "tasks/packings/mesh.hpp"

namespace isojam {

/// Exception: the faces of a mesh are not the surface of a convex solid. `deviation` is the distance, relative to the
/// diameter, by which points would have to be moved to make them one. It is 0 if moving points cannot achieve this.
class NoSurface : public ContentError {
 public:
  NoSurface(const std::string& problem, std::string remedy, std::size_t line, double deviation = 0)
      : ContentError(problem, std::move(remedy), line), deviation_(deviation) {}
  double deviation() const { return deviation_; }

 private:
  double deviation_;
};

/// A closed surface of polygons.
struct Surface {
  std::vector<Eigen::Vector3d> points;  ///< the points of all faces, in the unit of length of the file; each one once
  int unused = 0;                       ///< number of points of the mesh that belong to no face
  // The other members are set by closed_surface() only.
  double diameter = 0;          ///< largest distance between two points
  double volume = 0, area = 0;  ///< enclosed volume, and the sum of the areas of the faces
};

/// Largest number of different points of a surface. The search for their diameter visits all pairs.
inline constexpr std::size_t most_surface_points = most_hull_corners;

/// The points of all faces with at least three different corners, or all points of a file without faces, without checks
/// of the surface. Points with equal coordinates are one point.
Surface points_of(const Mesh& mesh);

/// Tolerance of the checks, in units of the diameter, for a mesh whose points are welded within `merge` diameters. It
/// is 1e-5 or 2·merge, whichever is larger. 1e-5 is one unit in the sixth digit of a coordinate, and coordinates in
/// files have at least seven digits.
double surface_tolerance(double merge);

/// Checks that the faces form one closed surface, that all of them are planar, and that it has no dents. Points within
/// `merge` diameters of each other count as one. All other checks have the tolerance surface_tolerance(merge). The time
/// is O(n²) for n different points. Throws NoSurface with the line of a face.
Surface closed_surface(const Mesh& mesh, double merge);

}  // namespace isojam
