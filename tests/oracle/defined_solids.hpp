#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/geometry/overlap/exact_pairs.hpp"
#include "tests/oracle/exact_overlap.hpp"

// User-defined solids whose vertices were moved far from the origin, scaled, rounded or merged, and references for them
// to 50 digits.

namespace isojam::oracle {

/// How the vertices of a solid are written.
struct Writing {
  const char* name;
  double scale = 1, origin = 0;  ///< factor of the vertices; coordinates of their origin
  int digits = 17;               ///< significant digits of each coordinate
  double merge = 0;              ///< RepairOptions::merge
};

struct DefinedSolid {
  std::vector<Eigen::Vector3d> given;  ///< vertices as they are written
  Writing writing;
  Solid solid;
};

/// Eight solids in each of eleven ways of writing them. As written, no face with four or more corners is exactly
/// planar.
const std::vector<DefinedSolid>& defined_solids();

/// A polyhedron with vertices of 50 digits.
struct RealBody {
  std::vector<RealVector> vertices;
  std::vector<std::vector<int>> faces;
};

/// The vertices of the engine's solid, whose doubles and low parts are exact numbers.
RealBody body_of(const ConvexSolid& solid);
/// The given vertices, moved and scaled so that the centroid is 0 and the volume 1.
RealBody normalised(const DefinedSolid& defined);

}  // namespace isojam::oracle
