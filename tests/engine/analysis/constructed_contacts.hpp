#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/packing/energy.hpp"
#include "engine/random/stream.hpp"

namespace isojam::constructed {

/// The touched site of a body: a point, the outward direction there (unit), and the features around it.
struct Site {
  Eigen::Vector3d point;
  Eigen::Vector3d outward;
  std::uint64_t faces = 0, edges = 0;
};

/// The vertex with its faces and edges, outward along its axis.
Site vertex_site(const ConvexSolid& solid, int vertex);
/// The midpoint of the edge with its two faces, outward along the bisector of their normals.
Site edge_site(const ConvexSolid& solid, int edge);
/// The centre of the face, without edges: the site of a touching vertex or edge.
Site face_site(const ConvexSolid& solid, int face);
/// The same with the edges of the face: the site of a touching face of another body, nearly parallel.
Site face_and_edges_site(const ConvexSolid& solid, int face);

/// Edge direction from tail to head.
Eigen::Vector3d direction(const ConvexSolid& solid, int edge);

/// B with its site on that of A and opposite outward directions. B is rotated by `spin` about them, then by the
/// rotation vector `tilt` (A's frame) about the touching point, then pushed into A by `depth`. The masks are those of
/// the sites.
Contact contact(const Site& a, const Site& b, double spin, const Eigen::Vector3d& tilt, double depth);

/// The same contact with the masks and the volume that overlap() finds.
Contact overlapped(const ConvexSolid& solid, Contact contact);

/// The contact from B's point of view.
Contact exchanged(const Contact& contact);

/// Uniform on the sphere, and uniform on SO(3).
Eigen::Vector3d random_direction(RandomStream& random);
Eigen::Quaterniond random_orientation(RandomStream& random);

}  // namespace isojam::constructed
