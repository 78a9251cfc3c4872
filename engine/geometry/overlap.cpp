#include "engine/geometry/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

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

/// Sums over the edges of one intersection, cross products as cross_zxy() has them.
struct Sums {
  Lanes twice_area = Lanes::all(0), moment = Lanes::all(0), prisms = Lanes::all(0);
};

void integrate_loops(const ContactLoops& loops, Sums* sums) {
  const auto corner = [&](std::uint32_t k) { return Lanes::load(loops.corner[k]); };
  for (int k = 0; k < loops.segments; ++k) {
    const ContactLoops::Segment s = loops.segment[k];
    Sums& sum = sums[s.faces / (SolidArrays::capacity * SolidArrays::capacity)];
    const Lanes v = corner(s.from), w = corner(s.to);
    const Lanes cross = cross_zxy(v, w), both = v + w, along = w - v;
    const Lanes a = corner(loops.hub[s.faces / SolidArrays::capacity]), b = corner(loops.hub[number_of_b(s.faces)]);
    sum.twice_area = sum.twice_area + cross;
    sum.moment = fma(along, isojam::sum(without_fourth(fma(v, both, w * w))), sum.moment);
    sum.prisms = sum.prisms + fan(cross, both, along, a, b);
  }
  for (int k = 0; k < loops.spans; ++k) {
    const ContactLoops::Span& s = loops.span[k];
    const Lanes v = Lanes::load(loops.corner[2 * k]), w = Lanes::load(loops.corner[2 * k + 1]);
    Lanes& prisms = sums[s.solid / 2].prisms;
    prisms = prisms + fan(cross_zxy(v, w), v + w, w - v, corner(loops.hub[s.left]), corner(loops.hub[s.right]));
  }
}

/// Writes every member of `result`.
void finish(const ContactLoops& loops, int p, const Eigen::Vector3d& r, const Sums& sums, Overlap& result) {
  result.path = OverlapPath::loop;
  result.faces_a = loops.faces[2 * p], result.faces_b = loops.faces[2 * p + 1];
  result.edges_a = loops.edges[2 * p], result.edges_b = loops.edges[2 * p + 1];
  result.volume = loops.up[p].dot(vector_of(yzx(sums.prisms))) / 6;
  result.area = vector_of(yzx(sums.twice_area)) / 2;
  result.moment = (r / 2).cross(result.area) - vector_of(sums.moment) / 6;
}

Overlap clipped(const PlacedPair& pair) {
  const Eigen::Matrix3d to_a = pair.a->rotation().transpose();
  Overlap result = clipped_overlap(pair.a->solid(), pair.b->solid(), {to_a * pair.b->rotation(), to_a * pair.r});
  result.area = pair.a->rotation() * result.area;
  result.moment = pair.a->rotation() * result.moment;
  return result;
}

/// At most max_pairs.
void overlap_few(std::span<const PlacedPair> pairs, ContactLoops& loops, std::span<SeparatingAxis> axes,
                 std::span<Overlap> out) {
  find_contact_loops(pairs, loops);
  Sums sums[ContactLoops::max_pairs];
  integrate_loops(loops, sums);
  for (int p = 0; p < loops.pairs; ++p) {
    const auto k = static_cast<std::size_t>(p);
    if (loops.verdict[p] == LoopVerdict::closed) {
      finish(loops, p, pairs[k].r, sums[p], out[k]);
      if (out[k].volume > 0) continue;  // or rounding ate a sliver
    }
    if (loops.verdict[p] == LoopVerdict::separated) {
      out[k] = {};
      axes[k] = loops.axis[p];
    } else {
      out[k] = clipped(pairs[k]);
    }
  }
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

void overlaps(std::span<const PlacedPair> pairs, std::span<SeparatingAxis> axes, std::span<Overlap> out) {
  ContactLoops loops;
  for (std::size_t k = 0; k < pairs.size(); k += ContactLoops::max_pairs) {
    const std::size_t n = std::min<std::size_t>(ContactLoops::max_pairs, pairs.size() - k);
    overlap_few(pairs.subspan(k, n), loops, axes.subspan(k, n), out.subspan(k, n));
  }
}

Overlap overlap(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r, SeparatingAxis& axis) {
  const PlacedPair pair{&a, &b, r};
  Overlap result;
  overlaps({&pair, 1}, {&axis, 1}, {&result, 1});
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
  ContactLoops loops;
  const PlacedPair pair{&a, &b, r};
  find_contact_loops({&pair, 1}, loops);
  Matrix6d hessian = Matrix6d::Zero();
  if (loops.verdict[0] != LoopVerdict::closed) return hessian;
  const double gauss = 0.5 / std::sqrt(3.0);
  for (int k = 0; k < loops.segments; ++k) {
    const ContactLoops::Segment& s = loops.segment[k];
    const Eigen::Vector3d n = a.normal(static_cast<int>(s.faces / 32)), m = b.normal(static_cast<int>(s.faces % 32));
    const Eigen::Vector3d from(loops.corner[s.from]), to(loops.corner[s.to]);
    const double sine = n.cross(m).norm();
    const Eigen::Vector3d along = to - from;
    if (!(sine > 0)) continue;
    const double weight = along.norm() / (2 * sine);
    for (const double t : {0.5 - gauss, 0.5 + gauss}) {
      const Eigen::Vector3d y = r / 2 + from + t * along;
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
