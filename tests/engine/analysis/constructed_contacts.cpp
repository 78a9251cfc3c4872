#include "tests/engine/analysis/constructed_contacts.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace isojam::constructed {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d direction(const ConvexSolid& solid, int edge) {
  const Edge& e = solid.edges()[edge];
  return (solid.vertices()[e.head] - solid.vertices()[e.tail]).normalized();
}

Site vertex_site(const ConvexSolid& solid, int vertex) {
  Site site{solid.vertices()[vertex], solid.vertices()[vertex].normalized()};
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const Edge& edge = solid.edges()[e];
    if (edge.tail != vertex && edge.head != vertex) continue;
    site.edges |= std::uint64_t{1} << e;
    site.faces |= std::uint64_t{1} << edge.left | std::uint64_t{1} << edge.right;
  }
  return site;
}

Site edge_site(const ConvexSolid& solid, int edge) {
  const Edge& e = solid.edges()[edge];
  const Vector3d bisector = solid.faces()[e.left].normal + solid.faces()[e.right].normal;
  return {(solid.vertices()[e.tail] + solid.vertices()[e.head]) / 2, bisector.normalized(),
          std::uint64_t{1} << e.left | std::uint64_t{1} << e.right, std::uint64_t{1} << edge};
}

Site face_site(const ConvexSolid& solid, int face) {
  const Face& f = solid.faces()[face];
  Vector3d centre = Vector3d::Zero();
  for (const int v : f.vertices) centre += solid.vertices()[v] / static_cast<double>(f.vertices.size());
  return {centre, f.normal, std::uint64_t{1} << face, 0};
}

Site face_and_edges_site(const ConvexSolid& solid, int face) {
  Site site = face_site(solid, face);
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    if (solid.edges()[e].left == face || solid.edges()[e].right == face) site.edges |= std::uint64_t{1} << e;
  }
  return site;
}

namespace {

/// A right-handed frame whose third axis is `axis`.
Matrix3d frame(const Vector3d& axis) {
  Matrix3d m;
  m.col(2) = axis;
  m.col(0) = axis.unitOrthogonal();
  m.col(1) = axis.cross(m.col(0));
  return m;
}

}  // namespace

Contact contact(const Site& a, const Site& b, double spin, const Vector3d& tilt, double depth) {
  const Matrix3d spun = AngleAxisd(spin, Vector3d::UnitZ()).toRotationMatrix();
  const Matrix3d facing = frame(-a.outward) * spun * frame(b.outward).transpose();
  Contact result;
  const double angle = tilt.norm();
  result.pose.rotation = angle > 0 ? Matrix3d(AngleAxisd(angle, tilt / angle).toRotationMatrix() * facing) : facing;
  result.pose.displacement = a.point - depth * a.outward - result.pose.rotation * b.point;
  result.displacement = result.pose.displacement;
  result.overlap.faces_a = a.faces;
  result.overlap.edges_a = a.edges;
  result.overlap.faces_b = b.faces;
  result.overlap.edges_b = b.edges;
  return result;
}

Contact overlapped(const ConvexSolid& solid, Contact contact) {
  contact.overlap = relative_overlap(solid, solid, contact.pose);
  return contact;
}

Contact exchanged(const Contact& contact) {
  Contact result = contact;
  result.pose.rotation = contact.pose.rotation.transpose();
  result.pose.displacement = -(result.pose.rotation * contact.pose.displacement);
  result.displacement = -contact.displacement;
  std::swap(result.pair.a, result.pair.b);
  std::swap(result.overlap.faces_a, result.overlap.faces_b);
  std::swap(result.overlap.edges_a, result.overlap.edges_b);
  return result;
}

Vector3d random_direction(RandomStream& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Vector3d(x, y, z).normalized();
}

Quaterniond random_orientation(RandomStream& random) {
  const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  return Quaterniond(w, x, y, z).normalized();
}

}  // namespace isojam::constructed
