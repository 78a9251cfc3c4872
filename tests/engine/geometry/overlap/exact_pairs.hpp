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

/// Two solids in the lab frame, with poses in double-double.
struct PosedPair {
  const ConvexSolid &a, &b;
  Pose at_a, at_b;
};

/// x_B − x_A.
Quad3 displacement(const PosedPair& pair);

/// The overlap by clipping in quadruple precision. S and M are in the lab frame.
QuadOverlap exact(const PosedPair& pair);

/// The overlap by overlap_with_hessian() in double-double.
Overlap found(const PosedPair& pair, OverlapHessian& hessian);
Overlap found(const PosedPair& pair);

/// Largest relative error of found(): of V relative to V, of S relative to |S|, and of M relative to |S| times the
/// inradius of A.
double error(const PosedPair& pair);
double error(const PosedPair& pair, const QuadOverlap& right, const Overlap& got);

/// Largest error of a column of ∂S_A/∂x_B in H_AB, relative to the norm of this block. The reference is differences of
/// S in quadruple precision.
double hessian_error(const PosedPair& pair);

/// A pair in which a face of B is in contact with a face of A. The angle between the faces is `tilt`, and their depth
/// is `depth`. The centres of the faces are displaced along the faces by at most a third of the radius of the smaller
/// face.
PosedPair flat_contact(const ConvexSolid& a, const ConvexSolid& b, double depth, double tilt, RandomStream& random);

/// A pair, and the line on which the centre of B moves.
struct Approach {
  PosedPair pair;
  Eigen::Vector3d from, outward;  ///< the centre of B is at `from` + t·`outward`; `outward` is a unit vector
};
/// Random orientations. B approaches the centre of A from a random direction.
Approach random_approach(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);
/// A vertex of B approaches the centre of a face of A.
Approach corner_over_face(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);
/// The midpoint of an edge of B approaches the midpoint of an edge of A that crosses it.
Approach edge_over_edge(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random);
/// An edge of B in the middle of a face of A, parallel to the face within `tilt`.
Approach edge_in_face(const ConvexSolid& a, const ConvexSolid& b, double tilt, RandomStream& random);

/// The pair at the distance where V of found() equals `volume` within a factor of 2; nullopt if V is discontinuous
/// there.
std::optional<PosedPair> at_volume(Approach approach, double volume);

/// The dual of `solid`: for each face with the unit normal n and the distance h from the centre, it has the vertex n/h.
/// The dual of a solid with many faces has many vertices.
ConvexSolid dual(const std::string& name, const ConvexSolid& solid);

/// n random points on a sphere. In their convex hull, all points are vertices and all faces are triangles.
std::vector<Eigen::Vector3d> points_on_sphere(int n, std::uint64_t seed);

}  // namespace isojam::testing_pairs
