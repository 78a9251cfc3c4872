#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/packing/energy.hpp"
#include "engine/random/stream.hpp"

namespace isojam::constructed {

/// The place on a solid where it touches: a point, the unit vector that points outwards there, and the faces and edges
/// at this point.
struct Site {
  Eigen::Vector3d point;
  Eigen::Vector3d outward;
  std::uint64_t faces = 0, edges = 0;
};

/// A vertex with its faces and edges; the outward direction is the axis of the vertex.
Site vertex_site(const ConvexSolid& solid, int vertex);
/// The midpoint of an edge with its two faces; the outward direction is the bisector of their normals.
Site edge_site(const ConvexSolid& solid, int edge);
/// The centre of a face without its edges, for contacts with a vertex or an edge of another solid.
Site face_site(const ConvexSolid& solid, int face);
/// The centre of a face with its edges, for contacts with a nearly parallel face of another solid.
Site face_and_edges_site(const ConvexSolid& solid, int face);

/// Unit vector along an edge, from tail to head.
Eigen::Vector3d direction(const ConvexSolid& solid, int edge);

/// A contact at two sites. First the point of B is placed on the point of A, with opposite outward directions. Then B
/// is rotated by `spin` about these directions, rotated by the rotation vector `tilt` (frame of A) about the common
/// point, and pushed into A by `depth`. The bits of faces and edges are those of the sites.
Contact contact(const Site& a, const Site& b, double spin, const Eigen::Vector3d& tilt, double depth);

/// The same contact with the faces, edges and volume that overlap() finds.
Contact overlapped(const ConvexSolid& solid, Contact contact);

/// The contact with A and B exchanged.
Contact exchanged(const Contact& contact);

/// Random unit vector, uniform on the sphere.
Eigen::Vector3d random_direction(RandomStream& random);
/// Random rotation, uniform on SO(3).
Eigen::Quaterniond random_orientation(RandomStream& random);

}  // namespace isojam::constructed
