#include "engine/packing/incipient_contact.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/packing/cell/strain.hpp"

namespace isojam {

namespace {

/// Stiffness of a flat contact with the vector area S against rotations about axes in the plane of its faces. The line
/// in which the face planes intersect is assumed to go through the centre of the contact. Then ∂V/∂τ ≈ |S|^(3/2)/5 for
/// a rotation τ, and ½ (∂V/∂τ)² = |S|³/50. All other kinds of contacts have a small area S, so this term is negligible
/// compared with ½ |∇V|².
Eigen::Matrix3d tilt_stiffness(const Eigen::Vector3d& area, const GyrationRadii& radii) {
  const double square = area.squaredNorm();
  if (!(square > 0)) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d in_plane = Eigen::Matrix3d::Identity() - area * area.transpose() / square;
  return square * std::sqrt(square) / (50 * radii.a * radii.b) * in_plane;
}

}  // namespace

LinearisedOverlap tangent(const Overlap& overlap, const Eigen::Vector3d& r, const GyrationRadii& radii) {
  const Eigen::Vector3d moment_b = r.cross(overlap.area) - overlap.moment;
  return {
      overlap.volume, joined(overlap.area, overlap.moment / radii.a), joined(-overlap.area, moment_b / radii.b), {}};
}

IncipientContact incipient_contact(int a, int b, const Overlap& now, const Overlap& closed, const Eigen::Vector3d& r,
                                   double probe_distance, const GyrationRadii& radii, const StrainBasis& strains) {
  IncipientContact pair;
  pair.a = a, pair.b = b;
  const double mean_radius = std::sqrt(radii.a * radii.b);
  pair.rotation_scale_a = mean_radius / radii.a, pair.rotation_scale_b = mean_radius / radii.b;
  const Eigen::Vector3d approach = probe_distance * r.normalized();
  if (now.touching()) pair.now = tangent(now, r, radii);
  if (closed.touching()) {
    pair.closed = tangent(closed, r - approach, radii);
    pair.closed.at_rest -= closed.area.dot(approach);  // b moves by −approach, and ∂V/∂x_b = −S
  }
  // A strain ε moves b by ε r, and ∂V/∂x_b = −S.
  if (strains.cols() > 0) {
    pair.now.slope_strains = -(strained(r) * strains).transpose() * now.area;
    pair.closed.slope_strains = -(strained(r) * strains).transpose() * closed.area;
  }
  const bool wider = closed.area.squaredNorm() > now.area.squaredNorm();
  pair.tilt = tilt_stiffness(wider ? closed.area : now.area, radii);
  return pair;
}

}  // namespace isojam
