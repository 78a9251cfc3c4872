#include "engine/geometry/overlap.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/geometry/contact_loop.hpp"

namespace isojam {

namespace {

/// d_L n_L − d_R n_R of a solid's edge, with plane distances from the loop's origin.
template <class Planes>
Eigen::Vector3d edge_normal(const Planes& planes, int left, int right, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d l(planes.nx[left], planes.ny[left], planes.nz[left]);
  const Eigen::Vector3d r(planes.nx[right], planes.ny[right], planes.nz[right]);
  return (planes.offset[left] - l.dot(origin)) * l - (planes.offset[right] - r.dot(origin)) * r;
}

Overlap integrate(const SolidArrays& a, const ContactLoop& loop) {
  Overlap result;
  result.path = OverlapPath::loop;
  result.edges_a = loop.edges_a;
  result.edges_b = loop.edges_b;
  double volume = 0;
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int k = 0; k < loop.segments; ++k) {
    const LoopSegment& s = loop.segment[k];
    const Eigen::Vector3d cross = s.from.cross(s.to);
    twice_area += cross;
    moment += (s.to - s.from) * (s.from.squaredNorm() + s.from.dot(s.to) + s.to.squaredNorm());
    const Eigen::Vector3d n(a.nx[s.face_a], a.ny[s.face_a], a.nz[s.face_a]);
    const Eigen::Vector3d m = loop.b.normal(s.face_b);
    volume += (a.offset[s.face_a] - n.dot(loop.origin)) * n.dot(cross) -
              (loop.b.offset[s.face_b] - m.dot(loop.origin)) * m.dot(cross);
    result.faces_a |= std::uint32_t{1} << s.face_a;
    result.faces_b |= std::uint32_t{1} << s.face_b;
  }
  for (int k = 0; k < loop.spans; ++k) {
    const EdgeSpan& s = loop.span[k];
    const Eigen::Vector3d cross = s.from.cross(s.to);
    volume +=
        (s.of_a ? edge_normal(a, s.left, s.right, loop.origin) : edge_normal(loop.b, s.left, s.right, loop.origin))
            .dot(cross);
    (s.of_a ? result.faces_a : result.faces_b) |= std::uint32_t{1} << s.left | std::uint32_t{1} << s.right;
  }
  result.volume = volume / 6;
  result.area = twice_area / 2;
  result.moment = loop.origin.cross(result.area) - moment / 6;
  return result;
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

Overlap overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, SeparatingAxis& axis) {
  ContactLoop loop;
  find_contact_loop(a, b, pose, loop);
  switch (loop.verdict) {
    case LoopVerdict::separated: axis = loop.axis; return {};
    case LoopVerdict::closed: {
      const Overlap result = integrate(a.arrays(), loop);
      if (result.volume > 0) return result;
      break;  // rounding ate a sliver
    }
    case LoopVerdict::degenerate: break;
  }
  return clipped_overlap(a, b, pose);
}

Overlap overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  SeparatingAxis unused;
  return overlap(a, b, pose, unused);
}

Matrix6d overlap_cross_hessian(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  ContactLoop loop;
  find_contact_loop(a, b, pose, loop);
  Matrix6d hessian = Matrix6d::Zero();
  if (loop.verdict != LoopVerdict::closed) return hessian;
  const double gauss = 0.5 / std::sqrt(3.0);
  for (int k = 0; k < loop.segments; ++k) {
    const LoopSegment& s = loop.segment[k];
    const Eigen::Vector3d n = a.faces()[s.face_a].normal;
    const Eigen::Vector3d m = loop.b.normal(s.face_b);
    const double sine = n.cross(m).norm();
    const Eigen::Vector3d along = s.to - s.from;
    if (!(sine > 0)) continue;
    const double weight = along.norm() / (2 * sine);
    for (const double t : {0.5 - gauss, 0.5 + gauss}) {
      const Eigen::Vector3d y = loop.origin + s.from + t * along;
      const Vector6d ua = joined(n, y.cross(n));
      const Vector6d ub = joined(m, (y - pose.displacement).cross(m));
      hessian.noalias() += (weight * ua) * ub.transpose();
    }
  }
  return hessian;
}

Matrix6d overlap_own_hessian(const Matrix6d& cross, const Eigen::Vector3d& area, const Eigen::Vector3d& r) {
  Matrix6d own = -cross;
  // θ×r = −[r]×θ: a turn of A about its centre carries B along.
  own.rightCols<3>() += cross.leftCols<3>() * skew(r);
  own.topRightCorner<3, 3>() -= skew(area);
  return (own + own.transpose()) / 2;
}

}  // namespace isojam
