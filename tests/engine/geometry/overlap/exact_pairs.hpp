#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/random/stream.hpp"

namespace isojam::testing_pairs {

/// Two solids of any kind and size in the lab, in double-double.
struct PosedPair {
  const ConvexSolid &a, &b;
  Pose at_a, at_b;
};

/// x_B − x_A.
Quad3 displacement(const PosedPair& pair);

/// By clipping in quadruple precision; S and M in the lab frame.
QuadOverlap exact(const PosedPair& pair);

/// By overlap_with_hessian() in double-double.
Overlap found(const PosedPair& pair, OverlapHessian& hessian);
Overlap found(const PosedPair& pair);

/// Largest error of what is found: of V over V, of S over |S|, of M over |S| and the inradius of A.
double error(const PosedPair& pair);

/// Largest error of a column of ∂S_A/∂x_B, against differences of S in quadruple precision, over that block of H_AB.
double hessian_error(const PosedPair& pair);

/// B, turned so that a face of it is on a face of A to within `tilt`, `depth` deep, middle on middle to within a third
/// of the lesser face.
PosedPair flat_contact(const ConvexSolid& a, const ConvexSolid& b, double depth, double tilt, RandomStream& random);

/// A pair, and the line along which B is moved into A.
struct Approach {
  PosedPair pair;
  Eigen::Vector3d from, outward;  ///< B's centre at `from` + t `outward`, |outward| = 1
};
/// Random orientations, from the centre in a random direction.
Approach random_approach(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);
/// A vertex of B over the middle of a face of A.
Approach corner_over_face(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);
/// An edge of B across an edge of A, middle over middle.
Approach edge_over_edge(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);

/// B's centre where V is what is asked, to a factor of 2; nullopt where it comes with a step.
std::optional<PosedPair> at_volume(Approach approach, double volume);

/// Points on a sphere: all of them vertices, and all faces triangles.
std::vector<Eigen::Vector3d> points_on_sphere(int n, std::uint64_t seed);

}  // namespace isojam::testing_pairs
