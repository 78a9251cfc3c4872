#include "engine/rigidity/contact_patch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/rigidity/rigidity.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;

/// A contact as its patch sees it, in A's body frame.
struct Site {
  const Contact& contact;
  const ConvexSolid &a, &b;
  Vector3d normal;  ///< out of A
  Vector3d attack;
};

Site site_of(const Packing& packing, const Contact& contact, const ContactForce& force) {
  const auto i = static_cast<std::size_t>(contact.pair.a), j = static_cast<std::size_t>(contact.pair.b);
  const Pose& pose = packing.poses[i];
  const Eigen::Quaterniond to_body = pose.orientation.conjugate();
  return {contact, packing.solids[i], packing.solids[j], to_body * force.normal,
          to_body * (force.attack - pose.position)};
}

double polygon_margin(const std::vector<Vector3d>& corners, const Vector3d& normal, const Vector3d& point) {
  Vector3d twice_area = Vector3d::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k)
    twice_area += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
  const double area = normal.dot(twice_area) / 2;
  if (!(area > 0)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector3d side = corners[(k + 1) % corners.size()] - corners[k];
    const Vector3d inwards = normal.cross(side);
    if (const double length = inwards.norm(); length > 0)
      least = std::min(least, inwards.dot(point - corners[k]) / length);
  }
  return std::max(least / std::sqrt(area), -1.0);
}

ContactPatch polygon_patch(const Packing& packing, const Site& site, int face) {
  const auto i = static_cast<std::size_t>(site.contact.pair.a), j = static_cast<std::size_t>(site.contact.pair.b);
  const Quad3 r = widened(displacement_double_double(packing, site.contact.pair));
  const auto cut = clipped_intersection(site.a, site.b, relative_pose(packing.poses[i], packing.poses[j], r));
  ContactPatch patch;
  for (const auto& polygon : cut.faces) {
    if (!polygon.of_a || polygon.face != face) continue;
    for (const int corner : polygon.loop)
      patch.corners.push_back(rounded(cut.points[static_cast<std::size_t>(corner)]));
  }
  if (patch.corners.size() < 3) throw std::invalid_argument("a face-face contact without a polygon");
  patch.margin = polygon_margin(patch.corners, site.normal, site.attack);
  return patch;
}

/// The piece of the segment from tail to head inside a solid, all in the solid's body frame, as parameters in [0, 1].
std::pair<double, double> piece_inside(const ConvexSolid& solid, const Vector3d& tail, const Vector3d& head) {
  double from = 0, to = 1;
  for (const auto& face : solid.faces()) {
    const double at_tail = face.normal.dot(tail) - face.offset, at_head = face.normal.dot(head) - face.offset;
    if (at_tail <= 0 && at_head <= 0) continue;
    const double crossing = at_tail / (at_tail - at_head);
    if (at_tail > 0) from = std::max(from, at_head < 0 ? crossing : 1.0);
    if (at_head > 0) to = std::min(to, at_tail < 0 ? crossing : 0.0);
  }
  return {from, std::max(from, to)};
}

ContactPatch edge_patch(const Site& site, const Alignment& alignment) {
  if (alignment.edge < 0) throw std::invalid_argument("an edge-face contact without an edge");
  const ConvexSolid &of_edge = alignment.edge_of_a ? site.a : site.b, &other = alignment.edge_of_a ? site.b : site.a;
  const RelativePose& pose = site.contact.pose;
  const Edge& edge = of_edge.edges()[static_cast<std::size_t>(alignment.edge)];
  const auto in_a = [&](int vertex) -> Vector3d {
    const Vector3d& v = of_edge.vertices()[static_cast<std::size_t>(vertex)];
    return alignment.edge_of_a ? v : pose.rotation * v + pose.displacement;
  };
  const auto in_other = [&](const Vector3d& x) -> Vector3d {
    return alignment.edge_of_a ? Vector3d(pose.rotation.transpose() * (x - pose.displacement)) : x;
  };
  const Vector3d tail = in_a(edge.tail), head = in_a(edge.head);
  const auto [from, to] = piece_inside(other, in_other(tail), in_other(head));
  ContactPatch patch;
  patch.corners = {tail + from * (head - tail), tail + to * (head - tail)};
  const Vector3d piece = patch.corners[1] - patch.corners[0];
  const Vector3d across = piece - site.normal * site.normal.dot(piece);
  const double size = across.squaredNorm();
  const double at = size > 0 ? across.dot(site.attack - patch.corners[0]) / size : 0;
  patch.margin = std::max(std::min(at, 1 - at), -1.0);
  return patch;
}

/// From where the force of the contact acts to the corners; along the edge where there are two.
std::vector<Vector3d> offsets(const ContactPatch& patch, const Vector3d& attack) {
  std::vector<Vector3d> list;
  for (const Vector3d& corner : patch.corners) {
    const Vector3d offset = corner - attack;
    const Vector3d piece = patch.corners.back() - patch.corners.front();
    const double size = piece.squaredNorm();
    if (patch.corners.size() == 2) {
      list.emplace_back(size > 0 ? Vector3d(piece * (piece.dot(offset) / size)) : Vector3d::Zero());
    } else {
      list.push_back(offset);
    }
  }
  return list;
}

}  // namespace

std::vector<ContactPatch> contact_patches(const Packing& packing, std::span<const Contact> contacts,
                                          std::span<const ContactForce> forces, std::span<const Alignment> alignments,
                                          std::span<const ContactClass> classes) {
  if (forces.size() != contacts.size() || alignments.size() != contacts.size() || classes.size() != contacts.size())
    throw std::invalid_argument("each contact has one force, one alignment and one class");
  std::vector<ContactPatch> patches;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Site site = site_of(packing, contacts[k], forces[k]);
    switch (classes[k]) {
      case ContactClass::face_face: patches.push_back(polygon_patch(packing, site, alignments[k].face_a)); break;
      case ContactClass::edge_face: patches.push_back(edge_patch(site, alignments[k])); break;
      case ContactClass::lower_order: patches.push_back({{site.attack}, 1}); break;
    }
  }
  return patches;
}

RigidityMatrix corner_constraints(const Packing& packing, std::span<const Contact> contacts,
                                  std::span<const ContactForce> forces, std::span<const ContactPatch> patches) {
  if (forces.size() != contacts.size() || patches.size() != contacts.size())
    throw std::invalid_argument("each contact has one force and one patch");
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts[c].pair.a), j = static_cast<std::size_t>(contacts[c].pair.b);
    const Pose& pose = packing.poses[i];
    const Vector3d area = pose.orientation * contacts[c].overlap.area / contacts[c].overlap.area.norm(),
                   moment = pose.orientation * contacts[c].overlap.moment / contacts[c].overlap.area.norm();
    for (const Vector3d& offset :
         offsets(patches[c], pose.orientation.conjugate() * (forces[c].attack - pose.position))) {
      const Vector3d couple = (pose.orientation * offset).cross(area);
      const Vector6d on_a = joined(area, (moment + couple) / packing.solids[i].gyration_radius());
      const Vector6d on_b =
          joined(-area, (contacts[c].displacement.cross(area) - moment - couple) / packing.solids[j].gyration_radius());
      const double length = std::sqrt(on_a.squaredNorm() + on_b.squaredNorm());
      for (int k = 0; k < 6; ++k) {
        entries.emplace_back(row, 6 * contacts[c].pair.a + k, on_a[k] / length);
        entries.emplace_back(row, 6 * contacts[c].pair.b + k, on_b[k] / length);
      }
      ++row;
    }
  }
  RigidityMatrix matrix;
  matrix.rows.resize(row, 6 * Eigen::Index{packing.size()});
  matrix.rows.setFromTriplets(entries.begin(), entries.end());
  matrix.forces = Eigen::VectorXd::Zero(row);
  return matrix;
}

OneSidedStresses one_sided_stresses(const Packing& packing, std::span<const Contact> contacts,
                                    std::span<const ContactForce> forces, std::span<const Alignment> alignments,
                                    std::span<const ContactClass> classes) {
  const auto rigidity = analyse_rigidity(class_constraints(packing, contacts, alignments, classes));
  OneSidedStresses result;
  result.dimension = rigidity.self_stress;
  result.constraints = rigidity.constraints;
  std::vector<double> margins;
  for (const ContactPatch& patch : contact_patches(packing, contacts, forces, alignments, classes)) {
    if (patch.corners.size() > 1) margins.push_back(patch.margin);
    result.outside_faces += patch.corners.size() > 2 && !(patch.margin > 0);
  }
  if (margins.empty()) return result;
  result.outside = static_cast<int>(std::count_if(margins.begin(), margins.end(), [](double m) { return !(m > 0); }));
  std::sort(margins.begin(), margins.end());
  result.least_margin = margins.front();
  result.median_margin = margins[margins.size() / 2];
  return result;
}

}  // namespace isojam
