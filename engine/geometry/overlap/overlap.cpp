#include "engine/geometry/overlap/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "engine/arithmetic/lanes.hpp"
#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/geometry/overlap/contact_loop.hpp"
#include "engine/geometry/overlap/cross_hessian.hpp"
#include "engine/geometry/overlap/own_hessians.hpp"
#include "engine/geometry/overlap/small_corners.hpp"

namespace isojam {

namespace {

/// Σ (v−o)×(w−o) (h_o+h_v+h_w), with lanes as in cross_zxy(), for the face left of an edge v → w with o = l, minus the
/// same for the face on the right with o = r: v×w (h_l−h_r) + (l (h_l+h_v+h_w) − r (h_r+h_v+h_w)) × (v−w).
inline Lanes fan(Lanes v_cross_w, Lanes v_plus_w, Lanes w_minus_v, Lanes l, Lanes r) {
  const Lanes lever = r * lane<3>(v_plus_w + r) - l * lane<3>(v_plus_w + l);
  return fma(v_cross_w, lane<3>(l - r), cross_zxy(lever, w_minus_v));
}

Eigen::Vector3d vector_of(Lanes a) {
  alignas(32) double lane[4];
  a.store(lane);
  return {lane[0], lane[1], lane[2]};
}

template <class Loop>
void integrate(const Loop& loop, Overlap& result) {
  const auto corner = [&](std::uint32_t k) { return Lanes::load(loop.corner[k]); };
  const auto hub = [&](std::uint32_t face) { return corner(loop.hub[face]); };
  Lanes twice_area = Lanes::all(0), moment = twice_area, prisms = twice_area;
  for (int k = 0; k < loop.segments; ++k) {
    const typename Loop::Segment& s = loop.segment[k];
    const Lanes v = corner(s.from), w = corner(s.to);
    const Lanes cross = cross_zxy(v, w), both = v + w, along = w - v;
    twice_area = twice_area + cross;
    moment = fma(along, sum(without_fourth(fma(v, both, w * w))), moment);
    prisms = prisms + fan(cross, both, along, hub(s.face_a), hub(Loop::face_of_b + s.face_b));
  }
  for (int k = 0; k < loop.spans; ++k) {
    const Lanes v = Lanes::load(loop.corner[2 * k]), w = Lanes::load(loop.corner[2 * k + 1]);
    prisms = prisms + fan(cross_zxy(v, w), v + w, w - v, hub(loop.span[k].left), hub(loop.span[k].right));
  }
  result.path = OverlapPath::loop;
  result.faces_a |= loop.faces[0], result.faces_b |= loop.faces[1];
  result.edges_a |= loop.edges[0], result.edges_b |= loop.edges[1];
  result.volume = loop.up.dot(vector_of(yzx(prisms))) / 6;
  result.area = vector_of(yzx(twice_area)) / 2;
  result.moment = loop.origin.cross(result.area) - vector_of(moment) / 6;
}

Overlap clipped(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  const Eigen::Matrix3d to_a = a.rotation().transpose();
  return clipped_overlap(a.solid(), b.solid(), RelativePose{to_a * b.rotation(), to_a * r});
}

Overlap clipped(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r) {
  const QuadMatrix to_a = transposed(widened(a.rotation_double_double()));
  const QuadPose pose{to_a * widened(b.rotation_double_double()), to_a * widened(r)};
  return narrowed(clipped_overlap(a.solid(), b.solid(), pose));
}

const Eigen::Vector3d& rounded(const Eigen::Vector3d& r) { return r; }
const Eigen::Vector3d& rounded(const DoubleDoubleVector& r) { return r.high; }

/// Input in double does not determine corners more accurately than double.
template <class Loop>
bool refined(const PlacedSolid&, const PlacedSolid&, const Eigen::Vector3d&, const Overlap&, Loop&) {
  return false;
}
template <class Loop>
bool refined(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, const Overlap& rough,
             Loop& loop) {
  return refine_small_corners(a, b, r, rough.area, loop);
}

template <class Displacement>
void find_loop(const PlacedSolid& a, const PlacedSolid& b, int edges, const Displacement& r,
               ContactLoop<SmallSolids>& loop) {
  if (edges <= narrow_edges) {
    find_contact_loop<narrow_edges>(a, b, r, loop);
  } else {
    find_contact_loop<wide_edges>(a, b, r, loop);
  }
}
template <class Displacement>
void find_loop(const PlacedSolid& a, const PlacedSolid& b, int, const Displacement& r, ContactLoop<LargeSolids>& loop) {
  find_contact_loop<large_edges>(a, b, r, loop);
}

void set_zero(OverlapHessian& hessian) {
  hessian.aa.setZero();
  hessian.ab.setZero();
  hessian.bb.setZero();
}

/// The overlap of solids with up to `edges` edges. It is inlined, because it is short for small solids, and called
/// once.
template <class Solids, class Displacement>
[[gnu::always_inline]] inline Overlap overlap_of(const PlacedSolid& a, const PlacedSolid& b, int edges,
                                                 const Displacement& r, SeparatingAxis& axis, OverlapHessian* hessian) {
  ContactLoop<Solids> loop;
  find_loop(a, b, edges, r, loop);
  Overlap result;
  if (loop.verdict == LoopVerdict::separated) {
    axis = loop.axis;
    if (hessian) set_zero(*hessian);
    return result;
  }
  if (loop.verdict == LoopVerdict::closed) {
    integrate(loop, result);
    if (refined(a, b, r, result, loop)) integrate(loop, result);
    if (result.volume > 0) {  // otherwise rounding lost a sliver
      if (!hessian) return result;
      set_cross_hessian(a, b, r, loop, hessian->ab);
      set_own_hessians(result.area, rounded(r), *hessian);
      return result;
    }
  }
  if (hessian) set_zero(*hessian);
  result = clipped(a, b, r);
  result.area = a.rotation() * result.area;
  result.moment = a.rotation() * result.moment;
  return result;
}

/// A separate function, so that the loop of large solids takes 300 kB of the stack only for large solids.
template <class Displacement>
[[gnu::noinline]] Overlap overlap_of_large(const PlacedSolid& a, const PlacedSolid& b, const Displacement& r,
                                           SeparatingAxis& axis, OverlapHessian* hessian) {
  return overlap_of<LargeSolids>(a, b, large_edges, r, axis, hessian);
}

/// Computes in double or double-double, depending on the type of r; `hessian` may be null.
template <class Displacement>
Overlap overlap_at(const PlacedSolid& a, const PlacedSolid& b, const Displacement& r, SeparatingAxis& axis,
                   OverlapHessian* hessian) {
  const int edges = std::max(a.solid().arrays().edges, b.solid().arrays().edges);
  if (edges > SmallSolids::edges) return overlap_of_large(a, b, r, axis, hessian);
  return overlap_of<SmallSolids>(a, b, edges, r, axis, hessian);
}

}  // namespace

Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis) {
  return overlap_at(a, b, r, axis, nullptr);
}

Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r, SeparatingAxis& axis) {
  return overlap_at(a, b, r, axis, nullptr);
}

Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis,
                             OverlapHessian& hessian) {
  return overlap_at(a, b, r, axis, &hessian);
}

Overlap overlap_with_hessian(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r,
                             SeparatingAxis& axis, OverlapHessian& hessian) {
  return overlap_at(a, b, r, axis, &hessian);
}

Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, SeparatingAxis& axis) {
  return overlap(LonePlacedSolid(a, Eigen::Matrix3d(Eigen::Matrix3d::Identity())), LonePlacedSolid(b, pose.rotation),
                 pose.displacement, axis);
}

Overlap relative_overlap(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose) {
  SeparatingAxis unused;
  return relative_overlap(a, b, pose, unused);
}

}  // namespace isojam
