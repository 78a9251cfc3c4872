#include "engine/geometry/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/geometry/contact_loop.hpp"

namespace isojam {

namespace {

/// Heights over a face plane of A or of B, negative inside.
class Heights {
 public:
  Heights(const PlacedSolid& a, const PlacedSolid& b, const ContactLoop& loop, int face)
      : plane_(face % face_of_b), of_a_(face < face_of_b) {
    // Over a solid's own plane heights are constants, over the other's they are in the table.
    const double* own = (of_a_ ? a : b).solid().arrays().height[plane_];
    const double* other = &(of_a_ ? loop.of_b : loop.of_a).of[0][plane_];
    (of_a_ ? a_ : b_) = {own, 1};
    (of_a_ ? b_ : a_) = {other, SolidArrays::capacity};
  }

  double of(const Corner& corner) const {
    if (corner.of_a != of_a_ && corner.plane == plane_) return 0;
    const Table& vertex = corner.of_a ? a_ : b_;
    return corner.weight_tail * vertex.first[vertex.stride * corner.tail] +
           corner.weight_head * vertex.first[vertex.stride * corner.head];
  }

 private:
  struct Table {
    const double* first;
    int stride;
  };
  Table a_{}, b_{};
  int plane_;
  bool of_a_;
};

/// Greatest depth of the other solid's vertices behind a plane.
double penetration(const Distances& d, int vertices, int plane) {
  double lowest = 0;
  for (int v = 0; v < vertices; ++v) lowest = std::min(lowest, d.of[v][plane]);
  return -lowest;
}

/// Of the planes that bound the intersection, the one that is penetrated least.
int reference_face(const PlacedSolid& a, const PlacedSolid& b, const ContactLoop& loop, const Overlap& result) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](double depth, int face) {
    if (depth < least) least = depth, best = face;
  };
  for (std::uint32_t faces = result.faces_a; faces; faces &= faces - 1) {
    const int f = std::countr_zero(faces);
    consider(penetration(loop.of_b, b.vertices(), f), f);
  }
  for (std::uint32_t faces = result.faces_b; faces; faces &= faces - 1) {
    const int f = std::countr_zero(faces);
    consider(penetration(loop.of_a, a.vertices(), f), face_of_b + f);
  }
  return best;
}

void mark_faces(const LoopEdge& edge, Overlap& result) {
  const std::uint64_t faces = std::uint64_t{1} << edge.left | std::uint64_t{1} << edge.right;
  result.faces_a |= static_cast<std::uint32_t>(faces);
  result.faces_b |= static_cast<std::uint32_t>(faces >> face_of_b);
}

/// V = Σ_f ∫_f h (n_P·n_f) dA: each face as a fan of triangles about one of its corners.
double volume(const PlacedSolid& a, const PlacedSolid& b, const ContactLoop& loop, int reference) {
  const Eigen::Vector3d up = reference < face_of_b ? a.normal(reference) : b.normal(reference - face_of_b);
  const Heights heights(a, b, loop, reference);
  std::array<int, 2 * SolidArrays::capacity> hub;
  hub.fill(-1);
  double six_volume = 0;
  const auto add = [&](const LoopEdge& edge) {
    const Corner &v = loop.corner[edge.from], &w = loop.corner[edge.to];
    const double h = heights.of(v) + heights.of(w);
    double sign = 1;
    for (const int face : {edge.left, edge.right}) {
      if (hub[face] < 0) hub[face] = edge.from;
      const Corner& o = loop.corner[hub[face]];
      six_volume += sign * (heights.of(o) + h) * up.dot((v.position - o.position).cross(w.position - o.position));
      sign = -1;
    }
  };
  for (int k = 0; k < loop.segments; ++k) add(loop.segment[k]);
  for (int k = 0; k < loop.spans; ++k) add(loop.span[k]);
  return six_volume / 6;
}

Overlap integrate(const PlacedSolid& a, const PlacedSolid& b, const ContactLoop& loop) {
  Overlap result;
  result.path = OverlapPath::loop;
  result.edges_a = loop.edges_a;
  result.edges_b = loop.edges_b;
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int k = 0; k < loop.segments; ++k) {
    const Eigen::Vector3d &v = loop.corner[loop.segment[k].from].position,
                          &w = loop.corner[loop.segment[k].to].position;
    twice_area += v.cross(w);
    moment += (w - v) * (v.squaredNorm() + v.dot(w) + w.squaredNorm());
    mark_faces(loop.segment[k], result);
  }
  for (int k = 0; k < loop.spans; ++k) mark_faces(loop.span[k], result);
  result.volume = volume(a, b, loop, reference_face(a, b, loop, result));
  result.area = twice_area / 2;
  result.moment = loop.origin.cross(result.area) - moment / 6;
  return result;
}

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

QuadPose relative_pose(const PlacedSolid& a, const PlacedSolid& b, const TwoDoubleVector& r) {
  const QuadMatrix to_a = transposed(widened(a.precise_rotation()));
  return {to_a * widened(b.precise_rotation()), to_a * widened(r)};
}

RelativePose relative_pose(const PlacedSolid& a, const PlacedSolid& b, const Eigen::Vector3d& r) {
  const Eigen::Matrix3d to_a = a.rotation().transpose();
  return {to_a * b.rotation(), to_a * r};
}

Overlap narrow(const Overlap& overlap) { return overlap; }
Overlap narrow(const QuadOverlap& overlap) { return narrowed(overlap); }

/// In double or in two doubles, as r is.
template <class Displacement>
Overlap overlap_at(const PlacedSolid& a, const PlacedSolid& b, const Displacement& r, SeparatingAxis& axis) {
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
  Overlap result = narrow(clipped_overlap(a.solid(), b.solid(), relative_pose(a, b, r)));
  result.area = a.rotation() * result.area;
  result.moment = a.rotation() * result.moment;
  return result;
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

namespace {

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
    const LoopEdge& s = loop.segment[k];
    const Eigen::Vector3d n = a.normal(s.left), m = b.normal(s.right - face_of_b);
    const Eigen::Vector3d &from = loop.corner[s.from].position, &to = loop.corner[s.to].position;
    const double sine_of_planes = sine_between(s.left, s.right - face_of_b);
    const Eigen::Vector3d along = to - from;
    if (!(sine_of_planes > 0)) continue;
    const double weight = along.norm() / (2 * sine_of_planes);
    for (const double t : {0.5 - gauss, 0.5 + gauss}) {
      const Eigen::Vector3d y = loop.origin + from + t * along;
      const Vector6d ua = joined(n, y.cross(n));
      const Vector6d ub = joined(m, (y - r).cross(m));
      hessian.noalias() += (weight * ua) * ub.transpose();
    }
  }
  return hessian;
}

}  // namespace

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
