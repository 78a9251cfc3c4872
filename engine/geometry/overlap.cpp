#include "engine/geometry/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/geometry/contact_loop.hpp"
#include "engine/geometry/lanes.hpp"

namespace isojam {

namespace {

/// Σ (v−o)×(w−o) (h_o+h_v+h_w), as cross_zxy() has it, for the face left of an edge v → w with o = l, minus the same
/// for the right with o = r: v×w (h_l−h_r) + (l (h_l+h_v+h_w) − r (h_r+h_v+h_w)) × (v−w).
inline Lanes fan(Lanes v_cross_w, Lanes v_plus_w, Lanes w_minus_v, Lanes l, Lanes r) {
  const Lanes lever = r * lane<3>(v_plus_w + r) - l * lane<3>(v_plus_w + l);
  return fma(v_cross_w, lane<3>(l - r), cross_zxy(lever, w_minus_v));
}

Eigen::Vector3d vector_of(Lanes a) {
  alignas(32) double lane[4];
  a.store(lane);
  return {lane[0], lane[1], lane[2]};
}

void integrate(const ContactLoop& loop, const Eigen::Vector3d& r, Overlap& result) {
  const auto corner = [&](std::uint32_t k) { return Lanes::load(loop.corner[k]); };
  const auto hub = [&](std::uint32_t face) { return corner(loop.hub[face]); };
  Lanes twice_area = Lanes::all(0), moment = twice_area, prisms = twice_area;
  for (int k = 0; k < loop.segments; ++k) {
    const ContactLoop::Segment& s = loop.segment[k];
    const Lanes v = corner(s.from), w = corner(s.to);
    const Lanes cross = cross_zxy(v, w), both = v + w, along = w - v;
    twice_area = twice_area + cross;
    moment = fma(along, sum(without_fourth(fma(v, both, w * w))), moment);
    prisms = prisms + fan(cross, both, along, hub(s.face_a), hub(ContactLoop::face_of_b + s.face_b));
  }
  for (int k = 0; k < loop.spans; ++k) {
    const Lanes v = Lanes::load(loop.corner[2 * k]), w = Lanes::load(loop.corner[2 * k + 1]);
    prisms = prisms + fan(cross_zxy(v, w), v + w, w - v, hub(loop.span[k].left), hub(loop.span[k].right));
  }
  result.path = OverlapPath::loop;
  result.faces_a = loop.faces[0], result.faces_b = loop.faces[1];
  result.edges_a = loop.edges[0], result.edges_b = loop.edges[1];
  result.volume = loop.up.dot(vector_of(yzx(prisms))) / 6;
  result.area = vector_of(yzx(twice_area)) / 2;
  result.moment = (r / 2).cross(result.area) - vector_of(moment) / 6;
}

Overlap clipped(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  const Eigen::Matrix3d to_a = a.rotation().transpose();
  return clipped_overlap(a.solid(), b.solid(), RelativePose{to_a * b.rotation(), to_a * r});
}

Overlap clipped(const PlacedSolid& a, const PlacedSolid& b, const TwoDoubleVector& r) {
  const QuadMatrix to_a = transposed(widened(a.precise_rotation()));
  const QuadPose pose{to_a * widened(b.precise_rotation()), to_a * widened(r)};
  return narrowed(clipped_overlap(a.solid(), b.solid(), pose));
}

const Eigen::Vector3d& rounded(const Eigen::Vector3d& r) { return r; }
const Eigen::Vector3d& rounded(const TwoDoubleVector& r) { return r.high; }

/// In double or in two doubles, as r is.
template <class Displacement>
Overlap overlap_at(const PlacedSolid& a, const PlacedSolid& b, const Displacement& r, SeparatingAxis& axis) {
  ContactLoop loop;
  find_contact_loop(a, b, r, loop);
  Overlap result;
  if (loop.verdict == LoopVerdict::separated) {
    axis = loop.axis;
    return result;
  }
  if (loop.verdict == LoopVerdict::closed) {
    integrate(loop, rounded(r), result);
    if (result.volume > 0) return result;  // or rounding ate a sliver
  }
  result = clipped(a, b, r);
  result.area = a.rotation() * result.area;
  result.moment = a.rotation() * result.moment;
  return result;
}

/// |n×m| of two unit normals.
double sine(const Eigen::Vector3d& n, const Eigen::Vector3d& m) { return n.cross(m).norm(); }

/// The same as |n×(n+m)| or |n×(n−m)|, of which the short sum is exact: right to its last bits for parallel planes too.
double sine(const TwoDoubleVector& n, const TwoDoubleVector& m) {
  const double sign = n.high.dot(m.high) < 0 ? 1 : -1;
  return n.high.cross((n.high + sign * m.high) + (n.low + sign * m.low)).norm();
}

/// `sine_between(i, j)` of face i of A and face j of B.
template <class Sine>
Matrix6d cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, const ContactLoop& loop,
                       const Sine& sine_between) {
  Matrix6d hessian = Matrix6d::Zero();
  if (loop.verdict != LoopVerdict::closed) return hessian;
  const double gauss = 0.5 / std::sqrt(3.0);
  for (int k = 0; k < loop.segments; ++k) {
    const ContactLoop::Segment& s = loop.segment[k];
    const auto i = static_cast<int>(s.face_a), j = static_cast<int>(s.face_b);
    const Eigen::Vector3d n = a.normal(i), m = b.normal(j);
    const Eigen::Vector3d from(loop.corner[s.from]), to(loop.corner[s.to]);
    const double sine_of_planes = sine_between(i, j);
    const Eigen::Vector3d along = to - from;
    if (!(sine_of_planes > 0)) continue;
    const double weight = along.norm() / (2 * sine_of_planes);
    for (const double t : {0.5 - gauss, 0.5 + gauss}) {
      const Eigen::Vector3d y = r / 2 + from + t * along;
      const Vector6d ua = joined(n, y.cross(n));
      const Vector6d ub = joined(m, (y - r).cross(m));
      hessian.noalias() += (weight * ua) * ub.transpose();
    }
  }
  return hessian;
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis) {
  return overlap_at(a, b, r, axis);
}

Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const TwoDoubleVector& r, SeparatingAxis& axis) {
  return overlap_at(a, b, r, axis);
}

Overlap overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, SeparatingAxis& axis) {
  return overlap(PlacedSolid(a, Eigen::Matrix3d::Identity()), PlacedSolid(b, pose.rotation), pose.displacement, axis);
}

Overlap overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  SeparatingAxis unused;
  return overlap(a, b, pose, unused);
}

Matrix6d overlap_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  ContactLoop loop;
  find_contact_loop(a, b, r, loop);
  return cross_hessian(a, b, r, loop, [&](int i, int j) { return sine(a.normal(i), b.normal(j)); });
}

Matrix6d overlap_cross_hessian(const PlacedSolid& a, const PlacedSolid& b, const TwoDoubleVector& r) {
  ContactLoop loop;
  find_contact_loop(a, b, r, loop);
  return cross_hessian(a, b, r.high, loop,
                       [&](int i, int j) { return sine(a.precise_normal(i), b.precise_normal(j)); });
}

Matrix6d overlap_cross_hessian(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  return overlap_cross_hessian(PlacedSolid(a, Eigen::Matrix3d::Identity()), PlacedSolid(b, pose.rotation),
                               pose.displacement);
}

Matrix6d overlap_own_hessian(const Matrix6d& cross, const Eigen::Vector3d& area, const Eigen::Vector3d& r) {
  Matrix6d own = -cross;
  // θ×r = −[r]×θ: a turn of A about its centre carries B along.
  own.rightCols<3>() += cross.leftCols<3>() * skew(r);
  own.topRightCorner<3, 3>() -= skew(area);
  return (own + own.transpose()) / 2;
}

}  // namespace isojam
