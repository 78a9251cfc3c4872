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

/// Two solids of any kind and size in the lab frame, in double-double.
struct PosedPair {
  const ConvexSolid &a, &b;
  Pose at_a, at_b;
};

/// x_B − x_A.
Quad3 displacement(const PosedPair& pair);

/// Overlap from clipping in quadruple precision; S and M in the lab frame.
QuadOverlap exact(const PosedPair& pair);

/// Overlap from overlap_with_hessian() in double-double.
Overlap found(const PosedPair& pair, OverlapHessian& hessian);
Overlap found(const PosedPair& pair);

/// Largest error of that overlap: of V over V, of S over |S|, of M over |S| and the inradius of A.
double error(const PosedPair& pair);

/// Largest error of a column of ∂S_A/∂x_B relative to this block of H_AB, with differences of S in quadruple precision
/// as reference.
double hessian_error(const PosedPair& pair);

/// B with one of its faces on a face of A, parallel within `tilt` and `depth` deep. The middles of the faces are at
/// most a third of the smaller face apart.
PosedPair flat_contact(const ConvexSolid& a, const ConvexSolid& b, double depth, double tilt, RandomStream& random);

/// A pair, and the line along which B is moved into A.
struct Approach {
  PosedPair pair;
  Eigen::Vector3d from, outward;  ///< B's centre is at `from` + t `outward`, |outward| = 1
};
/// Random orientations; B approaches A's centre from a random direction.
Approach random_approach(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);
/// A vertex of B over the middle of a face of A.
Approach corner_over_face(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);
/// An edge of B across an edge of A, middle over middle.
Approach edge_over_edge(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);

/// The pair at the distance where V equals `volume` within a factor of 2; nullopt if V jumps there.
std::optional<PosedPair> at_volume(Approach approach, double volume);

/// Points on a sphere: all of them are vertices, and all faces are triangles.
std::vector<Eigen::Vector3d> points_on_sphere(int n, std::uint64_t seed);

}  // namespace isojam::testing_pairs
