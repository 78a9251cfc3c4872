#include "tests/oracle/exact_overlap.hpp"

#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "tasks/extras/chart/pairs/clip_polytope.hpp"
#include "tests/oracle/exact_solid.hpp"

namespace isojam::oracle {

namespace {

using Point = Kernel::Point_3;
using Plane = Kernel::Plane_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// A solid as CGAL objects, with the exact numbers from which they were made.
struct Body {
  ExactSolid solid;
  std::vector<Point> vertices;
  std::vector<Plane> planes;  ///< the positive side of each plane is outside
};

/// The planes of A and of B that contain a point.
struct Incidence {
  std::uint32_t a = 0, b = 0;
};

using Candidates = std::map<Point, Incidence, Kernel::Less_xyz_3>;

Body make_body(ExactSolid solid) {
  using FT = Kernel::FT;
  Body body;
  for (const RationalVector& v : solid.vertices) body.vertices.emplace_back(FT(v[0]), FT(v[1]), FT(v[2]));
  for (const RationalPlane& p : solid.planes) {
    body.planes.emplace_back(FT(p.normal[0]), FT(p.normal[1]), FT(p.normal[2]), FT(Rational(-p.offset)));
  }
  body.solid = std::move(solid);
  return body;
}

/// The planes of `body` that contain the point; nullopt if the point is outside.
std::optional<std::uint32_t> incident_planes(const Body& body, const Point& point) {
  std::uint32_t incident = 0;
  for (std::size_t i = 0; i < body.planes.size(); ++i) {
    const CGAL::Oriented_side side = body.planes[i].oriented_side(point);
    if (side == CGAL::ON_POSITIVE_SIDE) return std::nullopt;
    if (side == CGAL::ON_ORIENTED_BOUNDARY) incident |= 1U << i;
  }
  return incident;
}

void add(Candidates& candidates, const Point& point, const Incidence& incidence) {
  CGAL::exact(point);  // exact coordinates now make later predicates faster
  Incidence& known = candidates[point];
  known.a |= incidence.a;
  known.b |= incidence.b;
}

/// Adds the vertices of `inner` that are inside `other`, and the points where its edges cross the faces of `other`.
void add_features(Candidates& candidates, const Body& inner, const Body& other, bool inner_is_a) {
  const auto put = [&](const Point& point, std::uint32_t own, std::uint32_t others) {
    add(candidates, point, inner_is_a ? Incidence{own, others} : Incidence{others, own});
  };
  for (std::size_t v = 0; v < inner.vertices.size(); ++v) {
    if (const auto incident = incident_planes(other, inner.vertices[v])) {
      put(inner.vertices[v], inner.solid.vertex_planes[v], *incident);
    }
  }
  for (const Plane& plane : other.planes) {
    std::vector<CGAL::Oriented_side> side;
    for (const Point& vertex : inner.vertices) side.push_back(plane.oriented_side(vertex));
    for (const Edge& edge : inner.solid.edges) {
      if (side[edge.tail] * side[edge.head] != -1) continue;
      const Kernel::Segment_3 segment(inner.vertices[edge.tail], inner.vertices[edge.head]);
      const auto crossing = CGAL::intersection(segment, plane);
      // CGAL 5 returns a boost::variant, CGAL 6 a std::variant.
      using boost::get;
      using std::get;
      const Point point = get<Point>(*crossing);
      if (const auto incident = incident_planes(other, point)) {
        put(point, 1U << edge.left | 1U << edge.right, *incident);
      }
    }
  }
}

/// Dimension of the hull of the points: 3 for a solid, 2 for a polygon, 1 for a segment, 0 for a point, and −1 if there
/// is none.
int affine_dimension(const Candidates& candidates) {
  std::vector<Point> basis;
  for (const auto& [point, incidence] : candidates) {
    const bool independent = basis.empty() || basis.size() == 1 ||
                             (basis.size() == 2 && !CGAL::collinear(basis[0], basis[1], point)) ||
                             (basis.size() == 3 && !CGAL::coplanar(basis[0], basis[1], basis[2], point));
    if (independent) basis.push_back(point);
    if (basis.size() == 4) break;
  }
  return static_cast<int>(basis.size()) - 1;
}

RealVector to_real(const Point& point) {
  return {oracle::to_real(CGAL::exact(point.x())), oracle::to_real(CGAL::exact(point.y())),
          oracle::to_real(CGAL::exact(point.z()))};
}

Eigen::Vector3d unit_normal(const RationalPlane& plane) {
  const Eigen::Vector3d n(plane.normal[0].get_d(), plane.normal[1].get_d(), plane.normal[2].get_d());
  return n.normalized();
}

/// Sums over the triangles and edges of the hull.
class HullSums {
 public:
  HullSums(const Mesh& hull, const Candidates& candidates, const Body& a, const Body& b)
      : hull_(hull), a_(a), b_(b), corners_(hull.number_of_vertices()), faces_(hull.number_of_faces()) {
    for (const auto v : hull.vertices()) corners_[v] = to_real(hull.point(v));
    for (const auto f : hull.faces()) {
      faces_[f] = {~0U, ~0U};
      for (const auto v : CGAL::vertices_around_face(hull.halfedge(f), hull)) {
        const Incidence& on = candidates.at(hull.point(v));
        faces_[f].a &= on.a;
        faces_[f].b &= on.b;
      }
    }
  }

  ExactOverlap sum(double plane_rounding) const {
    ExactOverlap result;
    for (const auto f : hull_.faces()) add_triangle(f, result);
    for (const auto e : hull_.edges()) add_edge(e, result);
    const Heights over_a = heights(a_), over_b = heights(b_);
    for (const auto f : hull_.faces()) {
      if (faces_[f].a != 0) result.contested_area += contested_area(f, over_b, plane_rounding);
      if (faces_[f].b != 0) result.contested_area += contested_area(f, over_a, plane_rounding);
    }
    return result;
  }

 private:
  using Heights = Eigen::MatrixXd;  ///< height of a corner of the hull (column) over a plane (row)

  std::array<std::size_t, 3> corners_of(Mesh::Face_index f) const {
    const Mesh::Halfedge_index h = hull_.halfedge(f);
    return {hull_.source(h), hull_.target(h), hull_.target(hull_.next(h))};
  }

  void add_triangle(Mesh::Face_index f, ExactOverlap& result) const {
    const auto [i, j, k] = corners_of(f);
    const RealVector &p = corners_[i], &q = corners_[j], &r = corners_[k];
    const RealVector area = (q - p).cross(r - p) / Real(2);
    result.volume += (p - corners_[0]).dot(area) / 3;
    result.faces_a |= faces_[f].a;
    result.faces_b |= faces_[f].b;
    if (faces_[f].a == 0) return;
    result.area += area;
    result.moment += ((p + q + r) / Real(3)).cross(area);
    if (faces_[f].b != 0) result.single_valued = false;
  }

  void add_edge(Mesh::Edge_index e, ExactOverlap& result) const {
    const Incidence& left = faces_[hull_.face(hull_.halfedge(e, 0))];
    const Incidence& right = faces_[hull_.face(hull_.halfedge(e, 1))];
    result.edges_a |= solid_edge(a_, left.a, right.a);
    result.edges_b |= solid_edge(b_, left.b, right.b);
  }

  static std::uint32_t solid_edge(const Body& body, std::uint32_t left, std::uint32_t right) {
    std::uint32_t found = 0;
    for (std::size_t e = 0; e < body.solid.edges.size(); ++e) {
      const std::uint32_t l = 1U << body.solid.edges[e].left, r = 1U << body.solid.edges[e].right;
      if ((left == l && right == r) || (left == r && right == l)) found |= 1U << e;
    }
    return found;
  }

  Heights heights(const Body& body) const {
    Heights result(body.solid.planes.size(), corners_.size());
    for (std::size_t i = 0; i < body.solid.planes.size(); ++i) {
      const RationalPlane& plane = body.solid.planes[i];
      const Eigen::Vector3d n = unit_normal(plane);
      const double offset = static_cast<double>(
          Real(oracle::to_real(plane.offset) / sqrt(oracle::to_real(dot(plane.normal, plane.normal)))));
      for (std::size_t v = 0; v < corners_.size(); ++v) result(i, v) = n.dot(corners_[v].cast<double>()) - offset;
    }
    return result;
  }

  /// Upper bound for the area of those parts of a triangle of one body that are within `shift` of a face plane of the
  /// other.
  double contested_area(Mesh::Face_index f, const Heights& heights, double shift) const {
    const auto [i, j, k] = corners_of(f);
    const RealVector &p = corners_[i], &q = corners_[j], &r = corners_[k];
    const double area = static_cast<double>((q - p).cross(r - p).norm()) / 2;
    double contested = 0;
    for (int plane = 0; plane < heights.rows(); ++plane) {
      const double nearest = -std::max({heights(plane, i), heights(plane, j), heights(plane, k)});
      const double farthest = -std::min({heights(plane, i), heights(plane, j), heights(plane, k)});
      // The height over the plane is linear. In a triangle that reaches the plane, at most the fraction 2
      // shift/farthest is within `shift`.
      if (nearest <= shift) contested += farthest <= 2 * shift ? area : area * 2 * shift / farthest;
    }
    return contested;
  }

  const Mesh& hull_;
  const Body& a_;
  const Body& b_;
  std::vector<RealVector> corners_;
  std::vector<Incidence> faces_;  ///< the planes that contain the whole triangle
};

RationalVector rational_displacement(const ExactPose& pose) {
  return {to_rational(pose.displacement[0]), to_rational(pose.displacement[1]), to_rational(pose.displacement[2])};
}

ExactSolid moved(SolidKind kind, const ExactPose& pose) {
  return moved(exact_solid(kind), rotation_matrix(pose.quaternion), rational_displacement(pose));
}

}  // namespace

ExactPose exact_pose(const Eigen::Quaterniond& quaternion, const Eigen::Vector3d& displacement) {
  return {quaternion.cast<Real>(), displacement.cast<Real>()};
}

RelativePose rounded(const ExactPose& pose) {
  const RationalMatrix exact = rotation_matrix(pose.quaternion);
  RelativePose result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result.rotation(row, column) = static_cast<double>(to_real(exact[row][column]));
    }
    result.displacement[row] = static_cast<double>(pose.displacement[row]);
  }
  return result;
}

ExactPose inverse(const ExactPose& pose) {
  const RealQuaternion& q = pose.quaternion;
  const RealQuaternion back(q.w(), -q.x(), -q.y(), -q.z());
  const RationalVector d = rotation_matrix(back) * rational_displacement(pose);
  return {back, -RealVector(oracle::to_real(d[0]), oracle::to_real(d[1]), oracle::to_real(d[2]))};
}

double plane_rounding(SolidKind a, SolidKind b) {
  return 64 * std::numeric_limits<double>::epsilon() * (platonic(a).circumradius() + platonic(b).circumradius());
}

ExactOverlap exact_overlap(SolidKind a, SolidKind b, const ExactPose& pose) {
  const Body body_a = make_body(exact_solid(a));
  const Body body_b = make_body(moved(b, pose));
  Candidates candidates;
  add_features(candidates, body_a, body_b, true);
  add_features(candidates, body_b, body_a, false);
  const int dimension = affine_dimension(candidates);
  ExactOverlap result;
  if (dimension < 3) {
    result.single_valued = dimension < 2;
    return result;
  }
  std::vector<Point> points;
  for (const auto& [point, incidence] : candidates) points.push_back(point);
  Mesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return HullSums(hull, candidates, body_a, body_b).sum(plane_rounding(a, b));
}

Real exact_clipped_volume(SolidKind a, SolidKind b, const ExactPose& pose) {
  const ExactSolid& solid_a = exact_solid(a);
  ClipPolytope<Rational> body(solid_a.vertices, solid_a.faces);
  for (const RationalPlane& plane : moved(b, pose).planes) body.clip(plane.normal, plane.offset);
  return to_real(body.volume());
}

}  // namespace isojam::oracle
