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

/// Moves the origin to a corner of the loop, so that nothing large cancels. Heights lose that corner's height only if
/// the reference plane does not bound the intersection: if it does, they are small already, and 0 on the plane.
Lanes move_origin(std::uint64_t faces, ContactLoop& loop) {
  double* first = loop.corner[loop.segment[0].from];
  Lanes origin = Lanes::load(first);
  if (faces >> loop.reference & 1) origin = origin * Lanes::of(1, 1, 1, 0);
  for (int k = 0; k < 2 * loop.spans; ++k) (Lanes::load(loop.corner[k]) - origin).store(loop.corner[k]);
  return origin;
}

/// Any corner of each face of the intersection, and the set of these faces.
struct Hubs {
  std::uint8_t corner[2 * SolidArrays::capacity];
  std::uint64_t faces = 0;

  void add(const LoopEdge& edge) {
    corner[edge.left] = corner[edge.right] = edge.from;
    faces |= std::uint64_t{1} << edge.left | std::uint64_t{1} << edge.right;
  }
};

/// Σ (v−o)×(w−o) (h_o+h_v+h_w), as cross_zxy() has it, for the face left of the edge − the same for the right.
Lanes fan(const ContactLoop& loop, const Hubs& hubs, const LoopEdge& edge, Lanes sum) {
  const Lanes v = Lanes::load(loop.corner[edge.from]), w = Lanes::load(loop.corner[edge.to]), h = v + w;
  const Lanes l = Lanes::load(loop.corner[hubs.corner[edge.left]]);
  const Lanes r = Lanes::load(loop.corner[hubs.corner[edge.right]]);
  const Lanes left = cross_zxy(v - l, w - l) * fourth(h + l);
  return sum + (left - cross_zxy(v - r, w - r) * fourth(h + r));
}

Eigen::Vector3d vector_of(Lanes a) {
  alignas(32) double lane[4];
  a.store(lane);
  return {lane[0], lane[1], lane[2]};
}

Overlap integrate(const PlacedSolid& a, const PlacedSolid& b, ContactLoop& loop) {
  Hubs hubs;
  for (int k = 0; k < loop.spans; ++k) hubs.add(loop.span[k]);
  for (int k = 0; k < loop.segments; ++k) hubs.add(loop.segment[k]);
  const Eigen::Vector3d origin = vector_of(move_origin(hubs.faces, loop));
  Lanes twice_area = Lanes::all(0), moment = twice_area, prisms = twice_area;
  for (int k = 0; k < loop.segments; ++k) {
    const LoopEdge& edge = loop.segment[k];
    const Lanes v = Lanes::load(loop.corner[edge.from]), w = Lanes::load(loop.corner[edge.to]);
    twice_area = twice_area + cross_zxy(v, w);
    moment = fma(w - v, sum3(fma(v, v, fma(v, w, w * w))), moment);
    prisms = fan(loop, hubs, edge, prisms);
  }
  for (int k = 0; k < loop.spans; ++k) prisms = fan(loop, hubs, loop.span[k], prisms);

  Overlap result;
  result.path = OverlapPath::loop;
  result.edges_a = loop.edges_a, result.edges_b = loop.edges_b;
  result.faces_a = static_cast<std::uint32_t>(hubs.faces);
  result.faces_b = static_cast<std::uint32_t>(hubs.faces >> face_of_b);
  const Eigen::Vector3d up =
      loop.reference < face_of_b ? a.normal(loop.reference) : b.normal(loop.reference - face_of_b);
  result.volume = up.dot(vector_of(yzx(prisms))) / 6;
  result.area = vector_of(yzx(twice_area)) / 2;
  result.moment = origin.cross(result.area) - vector_of(moment) / 6;
  return result;
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis) {
  ContactLoop loop;
  find_contact_loop(a, b, r, loop);
  switch (loop.verdict) {
    case LoopVerdict::separated: axis = loop.axis; return {};
    case LoopVerdict::closed: {
      const Overlap result = integrate(a, b, loop);
      if (result.volume > 0) return result;
      break;  // rounding ate a sliver
    }
    case LoopVerdict::degenerate: break;
  }
  const Eigen::Matrix3d to_a = a.rotation().transpose();
  Overlap result = clipped_overlap(a.solid(), b.solid(), {to_a * b.rotation(), to_a * r});
  result.area = a.rotation() * result.area;
  result.moment = a.rotation() * result.moment;
  return result;
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
  Matrix6d hessian = Matrix6d::Zero();
  if (loop.verdict != LoopVerdict::closed) return hessian;
  const double gauss = 0.5 / std::sqrt(3.0);
  for (int k = 0; k < loop.segments; ++k) {
    const LoopEdge& s = loop.segment[k];
    const Eigen::Vector3d n = a.normal(s.left), m = b.normal(s.right - face_of_b);
    const Eigen::Vector3d from(loop.corner[s.from]), to(loop.corner[s.to]);
    const double sine = n.cross(m).norm();
    const Eigen::Vector3d along = to - from;
    if (!(sine > 0)) continue;
    const double weight = along.norm() / (2 * sine);
    for (const double t : {0.5 - gauss, 0.5 + gauss}) {
      const Eigen::Vector3d y = from + t * along;
      const Vector6d ua = joined(n, y.cross(n));
      const Vector6d ub = joined(m, (y - r).cross(m));
      hessian.noalias() += (weight * ua) * ub.transpose();
    }
  }
  return hessian;
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
