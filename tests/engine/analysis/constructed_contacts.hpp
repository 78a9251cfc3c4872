#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/packing/energy.hpp"
#include "engine/random/stream.hpp"

namespace isojam::constructed {

/// Where a body is touched: a point of it, an outward direction there (unit), and the features about it.
struct Site {
  Eigen::Vector3d point;
  Eigen::Vector3d outward;
  std::uint64_t faces = 0, edges = 0;
};

/// The vertex with its faces and edges, outward along its axis.
Site vertex_site(const ConvexSolid& solid, int vertex);
/// The middle of the edge with its two faces, outward along the bisector of their normals.
Site edge_site(const ConvexSolid& solid, int edge);
/// The centre of the face, without edges: as a vertex or an edge would touch it.
Site face_site(const ConvexSolid& solid, int face);
/// The same with the edges of the face, as a face of another body, nearly parallel, would touch it.
Site face_and_edges_site(const ConvexSolid& solid, int face);

/// Edge direction tail → head.
Eigen::Vector3d direction(const ConvexSolid& solid, int edge);

/// B with its site on that of A, the outward directions opposite, turned by `spin` about them, then by the
/// rotation vector `tilt` (A's frame) about the point of touch, then pushed into A by `depth`. The masks are those of
/// the sites.
Contact contact(const Site& a, const Site& b, double spin, const Eigen::Vector3d& tilt, double depth);

/// The same contact with the masks and the volume that overlap() finds.
Contact overlapped(const ConvexSolid& solid, Contact contact);

/// The contact as B sees it.
Contact exchanged(const Contact& contact);

/// Uniform on the sphere, and on SO(3).
Eigen::Vector3d random_direction(RandomStream& random);
Eigen::Quaterniond random_orientation(RandomStream& random);

}  // namespace isojam::constructed
