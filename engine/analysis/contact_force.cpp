#include "engine/analysis/contact_force.hpp"

#include <algorithm>

#include "engine/geometry/overlap/penetration.hpp"
#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

using Polygon = QuadIntersection::Polygon;

Quad3 normal_of(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose, const Polygon& face) {
  return face.of_a ? a.arrays().normal(face.face) : pose.rotation * b.arrays().normal(face.face);
}

/// Centroid of a convex polyhedron, computed from tetrahedra that share one of its corners.
Quad3 centroid(const QuadIntersection& intersection) {
  const auto point = [&](int k) { return intersection.points[static_cast<std::size_t>(k)]; };
  const Quad3 origin = point(intersection.faces.front().loop.front());
  Quad volume = 0;
  Quad3 moment{};
  for (const Polygon& face : intersection.faces) {
    const Quad3 p = point(face.loop[0]) - origin;
    for (std::size_t k = 1; k + 1 < face.loop.size(); ++k) {
      const Quad3 q = point(face.loop[k]) - origin, s = point(face.loop[k + 1]) - origin;
      const Quad six_volumes = dot(p, cross(q, s));
      volume += six_volumes;
      moment = moment + (six_volumes / 4) * (p + q + s);
    }
  }
  return origin + (1 / volume) * moment;
}

/// Number of corners of `polygon` that are not corners of `other`. If a solid is given in double precision, the planes
/// that meet in one of its vertices meet in several points within rounding errors. These points count as one corner.
int own_corners(const QuadIntersection& intersection, const Polygon& polygon, const Polygon& other, Quad rounding) {
  std::vector<Quad3> corners;
  for (const int corner : polygon.loop) {
    if (std::find(other.loop.begin(), other.loop.end(), corner) != other.loop.end()) continue;
    const Quad3& here = intersection.points[static_cast<std::size_t>(corner)];
    const bool is_new =
        std::all_of(corners.begin(), corners.end(), [&](const Quad3& there) { return norm(here - there) > rounding; });
    if (is_new) corners.push_back(here);
  }
  return static_cast<int>(corners.size());
}

/// True if a corner of the intersection is a vertex of A or B, that is, if it lies only on faces of one solid.
bool has_vertex(const QuadIntersection& intersection) {
  std::vector<int> owners(intersection.points.size(), 0);
  for (const Polygon& face : intersection.faces) {
    for (const int corner : face.loop) owners[static_cast<std::size_t>(corner)] |= face.of_a ? 1 : 2;
  }
  return std::any_of(owners.begin(), owners.end(), [](int owner) { return owner == 1 || owner == 2; });
}

}  // namespace

ContactKind contact_kind(const ConvexSolid& a, const ConvexSolid& b, const QuadPose& pose,
                         const QuadIntersection& intersection, const Quad3& area) {
  const Polygon *of_a = nullptr, *of_b = nullptr;
  Quad most_a = 0, most_b = 0;
  for (const Polygon& face : intersection.faces) {
    const Quad turned = dot(area, normal_of(a, b, pose, face));
    if (face.of_a && (!of_a || turned > most_a)) of_a = &face, most_a = turned;
    if (!face.of_a && (!of_b || turned < most_b)) of_b = &face, most_b = turned;
  }
  if (!of_a || !of_b) return ContactKind::compound;
  const Quad rounding = gap_tolerance(a, b, narrowed(pose));
  switch (
      std::min(own_corners(intersection, *of_a, *of_b, rounding), own_corners(intersection, *of_b, *of_a, rounding))) {
    case 0: return ContactKind::compound;
    case 1: return has_vertex(intersection) ? ContactKind::vertex_face : ContactKind::edge_edge;
    case 2: return ContactKind::edge_face;
    default: return ContactKind::face_face;
  }
}

ContactForce contact_force(const Packing& packing, const NeighbourPair& pair) {
  const auto i = static_cast<std::size_t>(pair.a), j = static_cast<std::size_t>(pair.b);
  const ConvexSolid &a = packing.solids[i], &b = packing.solids[j];
  const Quad3 r = widened(displacement_double_double(packing, pair));
  const QuadPose pose = relative_pose(packing.poses[i], packing.poses[j], r);
  const QuadIntersection intersection = clipped_intersection(a, b, pose);
  const QuadOverlap overlap = overlap_of(a, b, intersection);
  ContactForce result;
  if (!(overlap.volume > 0)) return result;
  const QuadMatrix to_lab = quad_rotation(packing.poses[i]);
  const Quad3 area = to_lab * overlap.area, moment = to_lab * overlap.moment;
  const Quad size = norm(area), pull = -overlap.volume / 2;
  const Quad3 normal = (1 / size) * area;
  // S × M/S² is the point nearest to A's centre on the line about which the moment has no component perpendicular to S.
  const Quad along = dot(normal, to_lab * centroid(intersection));
  const Quad3 attack = (1 / (size * size)) * cross(area, moment) + along * normal;
  result.volume = static_cast<double>(overlap.volume);
  result.area = static_cast<double>(size);
  result.normal = rounded(normal);
  result.force_a = rounded(pull * area);
  result.attack = rounded(quad_position(packing.poses[i]) + attack);
  result.torque_a = rounded(pull * moment);
  result.torque_b = rounded(pull * (cross(r, area) - moment));
  result.depth = static_cast<double>(penetration(a, b, pose).depth);
  result.kind = contact_kind(a, b, pose, intersection, overlap.area);
  return result;
}

std::vector<ContactForce> contact_forces(const Packing& packing, std::span<const Contact> contacts) {
  std::vector<ContactForce> forces(contacts.size());
  for_each_small(contacts.size(), [&](std::size_t k) { forces[k] = contact_force(packing, contacts[k].pair); });
  return forces;
}

}  // namespace isojam
