#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "engine/geometry/repair.hpp"
#include "tasks/packings/mesh.hpp"

namespace isojam {

/// The corners of the solid that a mesh describes.
struct Intake {
  std::vector<Eigen::Vector3d> vertices;  ///< corners in the unit of length of the file, after the repairs
  RepairReport report;                    ///< the repairs that were made
  std::vector<std::string> notes;         ///< parts of the file that do not belong to the solid
};

/// Decides which solid a mesh describes. With options.hull, this is the convex hull of the corners of its faces.
/// Otherwise the mesh must be the surface of a convex solid, where a planar face may be divided into several polygons.
/// Any other repair is made only if `options` allows it. Throws ContentError with the line of a face and a remedy. If a
/// repair makes a solid of the mesh, the remedy states it.
Intake solid_in(const Mesh& mesh, const RepairOptions& options);

/// The change of a definition that removes the error of these points. It was tried with them.
std::string remedy_for(const NoSolid& error, std::span<const Eigen::Vector3d> points, const RepairOptions& options);

}  // namespace isojam
