#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/geometry/repair.hpp"
#include "tasks/packings/mesh.hpp"

namespace isojam {

/// The corners of the solid that a mesh describes.
struct Intake {
  std::vector<Eigen::Vector3d> vertices;  ///< corners in the unit of length of the file, or joined and moved by repairs
  RepairReport report;                    ///< the repairs that were made
  std::vector<std::string> notes;         ///< parts of the file that do not belong to the solid
};

/// Decides which solid a mesh describes. With options.hull, this is the convex hull of the corners of its faces.
/// Otherwise the mesh must be the surface of a convex solid; its faces may be divided. Nothing else is repaired unless
/// `options` allows it. Throws ContentError with the line of a face and a remedy, which states the value of
/// options.merge that would repair the mesh if there is one. Throws NoSolid if the repaired corners form no solid.
Intake solid_in(const Mesh& mesh, const RepairOptions& options);

}  // namespace isojam
