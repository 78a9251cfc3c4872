#include "engine/analysis/alignment/critical_angles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;

constexpr double right_angle = std::numbers::pi / 2;

double angle_between(const Vector3d& u, const Vector3d& v) { return nearest::atan2(u.cross(v).norm(), u.dot(v)); }

/// The vertex figure: angles that the edges and the face normals at a vertex form with the axis through the vertex.
struct VertexFigure {
  std::vector<double> edges, normals;
};

std::vector<VertexFigure> vertex_figures(const ConvexSolid& solid) {
  const std::vector<Vector3d>& vertices = solid.vertices();
  std::vector<VertexFigure> figures(vertices.size());
  for (const Edge& edge : solid.edges()) {
    const Vector3d along = vertices[edge.head] - vertices[edge.tail];
    figures[edge.tail].edges.push_back(angle_between(-along, vertices[edge.tail]));
    figures[edge.head].edges.push_back(angle_between(along, vertices[edge.head]));
  }
  for (const Face& face : solid.faces()) {
    for (const int v : face.vertices) figures[v].normals.push_back(angle_between(face.normal, vertices[v]));
  }
  return figures;
}

std::vector<double> dihedral_angles(const ConvexSolid& solid) {
  std::vector<double> angles;
  for (const Edge& edge : solid.edges()) {
    const Vector3d& left = solid.faces()[edge.left].normal;
    const Vector3d& right = solid.faces()[edge.right].normal;
    angles.push_back(std::numbers::pi - angle_between(left, right));
  }
  return angles;
}

/// The common value of all angles; nullopt if they differ. The coordinates of vertices are rounded, so equal angles
/// differ by a few units in the last place of a length, divided by the length of an edge.
std::optional<double> common(const ConvexSolid& solid, const std::vector<double>& angles) {
  double shortest_edge = solid.diameter();
  for (const Edge& edge : solid.edges()) {
    shortest_edge = std::min(shortest_edge, (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).norm());
  }
  const double tolerance = 64 * std::numeric_limits<double>::epsilon() * solid.diameter() / shortest_edge;
  const auto [least, greatest] = std::minmax_element(angles.begin(), angles.end());
  if (*greatest - *least > tolerance) return std::nullopt;
  return angles.front();
}

/// Angles that all vertices and all edges of a solid have in common.
struct SharedAngles {
  double dihedral, edge, normal;  ///< edge and normal as in VertexFigure
};

std::optional<SharedAngles> shared_angles(const ConvexSolid& solid) {
  std::vector<double> edge_angles, normal_angles;
  for (const VertexFigure& figure : vertex_figures(solid)) {
    edge_angles.insert(edge_angles.end(), figure.edges.begin(), figure.edges.end());
    normal_angles.insert(normal_angles.end(), figure.normals.begin(), figure.normals.end());
  }
  const auto dihedral = common(solid, dihedral_angles(solid));
  const auto edge = common(solid, edge_angles), normal = common(solid, normal_angles);
  if (!dihedral || !edge || !normal) return std::nullopt;
  return SharedAngles{*dihedral, *edge, *normal};
}

/// The smallest 1 − cos θ for which arccos gives θ to half of its digits.
constexpr double flat = 0x1p-26;

/// θ = arccos(cos α cos β), where `product` is cos α cos β. For small angles the product has no digits of θ left. Then
/// sin²(θ/2) = p + q − 2pq with p = sin²(α/2) and q = sin²(β/2).
double angle_of_product(double product, double alpha, double beta) {
  if (1 - product > flat) return nearest::acos(product);
  const double p = squared(nearest::sin(alpha / 2)), q = squared(nearest::sin(beta / 2));
  return 2 * nearest::asin(std::sqrt(p + q - 2 * p * q));
}

void set_edge_angles(double half_dihedral, CriticalAngles& critical) {
  const double sine = nearest::sin(half_dihedral), alpha = right_angle - half_dihedral;
  // Edge-edge: the edges cross at a right angle, and each pair of faces is symmetric about the line of contact.
  critical.ef_edge_edge = alpha;
  critical.ff_edge_edge = angle_of_product(sine * sine, alpha, alpha);
  // Edge-face: the two faces at the edge have the same angle with the face that contains it.
  critical.ff_edge_face = alpha;
}

/// The normal cone of a vertex: the outward normals of all planes that touch the solid only at this vertex. On the unit
/// sphere it is a polygon. Its corners are the normals of the faces that meet in the vertex, and its sides are
/// perpendicular to the edges.
struct NormalCone {
  std::vector<Vector3d> corners, sides;  ///< unit vectors; directions d of the cone have d·side ≥ 0
};

std::vector<NormalCone> normal_cones(const ConvexSolid& solid) {
  std::vector<NormalCone> cones(solid.vertices().size());
  for (const Edge& edge : solid.edges()) {
    const Vector3d along = (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).normalized();
    cones[edge.tail].sides.emplace_back(-along);
    cones[edge.head].sides.push_back(along);
  }
  for (const Face& face : solid.faces()) {
    for (const int v : face.vertices) cones[v].corners.push_back(face.normal);
  }
  return cones;
}

double least_product(const std::vector<Vector3d>& list, const Vector3d& direction) {
  double least = 1;
  for (const Vector3d& each : list) least = std::min(least, each.dot(direction));
  return least;
}

double greatest_product(const std::vector<Vector3d>& list, const Vector3d& direction) {
  double greatest = -1;
  for (const Vector3d& each : list) greatest = std::max(greatest, each.dot(direction));
  return greatest;
}

/// Calls look(d) for every unit vector d that has the same product with three vectors of a list, and for −d.
template <class Look>
void for_each_centre(const std::vector<Vector3d>& list, const Look& look) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = i + 1; j < list.size(); ++j) {
      for (std::size_t k = j + 1; k < list.size(); ++k) {
        const Vector3d axis = (list[j] - list[i]).cross(list[k] - list[i]);
        if (axis.squaredNorm() == 0) continue;
        look(axis.normalized());
        look(-axis.normalized());
      }
    }
  }
}

/// The largest angle of a direction in the cone to the nearest side: the radius of the inscribed circle. The circle
/// touches three sides, or two sides where their great circles are farthest apart.
double inscribed_radius(const NormalCone& cone) {
  double best = 0;
  const auto look = [&](const Vector3d& d) { best = std::max(best, least_product(cone.sides, d)); };
  for_each_centre(cone.sides, look);
  for (const Vector3d& side : cone.sides) {
    for (const Vector3d& other : cone.sides) look((side + other).stableNormalized());
  }
  return nearest::asin(std::min(1.0, best));
}

/// The largest angle of a direction in the cone to the nearest corner. This direction has the same angle to three
/// corners, or it is on a side and has the same angle to two corners.
double farthest_from_corners(const NormalCone& cone, double tolerance) {
  double best = 1, narrow = 0;  // `narrow` is the same angle where arccos(best) has lost half of its digits
  const auto look = [&](const Vector3d& d) {
    if (least_product(cone.sides, d) < -tolerance) return;
    const double product = greatest_product(cone.corners, d);
    best = std::min(best, product);
    if (1 - product > flat) return;
    double angle = std::numbers::pi;
    for (const Vector3d& corner : cone.corners) angle = std::min(angle, angle_between(corner, d));
    narrow = std::max(narrow, angle);
  };
  for_each_centre(cone.corners, look);
  for (const Vector3d& side : cone.sides) {
    for (std::size_t i = 0; i < cone.corners.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3d d = side.cross(cone.corners[i] - cone.corners[j]);
        if (d.norm() <= tolerance) continue;
        look(d.normalized());
        look(-d.normalized());
      }
    }
  }
  return 1 - best > flat ? nearest::acos(std::max(-1.0, best)) : narrow;
}

}  // namespace

double CriticalAngles::ef_min() const { return std::min(ef_vertex_face, ef_edge_edge); }
double CriticalAngles::ff_min() const { return std::min({ff_vertex_face, ff_edge_edge, ff_edge_face}); }

CriticalAngles critical_angles(const ConvexSolid& solid) {
  const auto shared = shared_angles(solid);
  if (!shared) return critical_angles_of_cones(solid);
  CriticalAngles critical;
  // Vertex-face: the axis of the vertex points along the inward normal of the face.
  critical.ef_vertex_face = right_angle - shared->edge;
  critical.ff_vertex_face = shared->normal;
  set_edge_angles(shared->dihedral / 2, critical);
  return critical;
}

bool has_like_features(const ConvexSolid& solid) {
  const std::size_t sides = solid.faces().front().vertices.size();
  return shared_angles(solid) && std::all_of(solid.faces().begin(), solid.faces().end(),
                                             [&](const Face& face) { return face.vertices.size() == sides; });
}

CriticalAngles critical_angles_of_cones(const ConvexSolid& solid) {
  const std::vector<double> dihedral = dihedral_angles(solid);
  CriticalAngles critical;
  set_edge_angles(*std::max_element(dihedral.begin(), dihedral.end()) / 2, critical);
  critical.ef_vertex_face = critical.ff_vertex_face = std::numbers::pi;
  for (const NormalCone& cone : normal_cones(solid)) {
    const double tolerance = 64 * std::numeric_limits<double>::epsilon() * solid.diameter() / solid.inradius();
    critical.ef_vertex_face = std::min(critical.ef_vertex_face, inscribed_radius(cone));
    critical.ff_vertex_face = std::min(critical.ff_vertex_face, farthest_from_corners(cone, tolerance));
  }
  return critical;
}

CriticalAngles critical_angles(const ConvexSolid& a, const ConvexSolid& b) {
  const CriticalAngles of_a = critical_angles(a);
  if (&a == &b) return of_a;
  const CriticalAngles of_b = critical_angles(b);
  return {.ef_vertex_face = std::min(of_a.ef_vertex_face, of_b.ef_vertex_face),
          .ef_edge_edge = std::min(of_a.ef_edge_edge, of_b.ef_edge_edge),
          .ff_vertex_face = std::min(of_a.ff_vertex_face, of_b.ff_vertex_face),
          .ff_edge_edge = angle_of_product(nearest::cos(of_a.ff_edge_face) * nearest::cos(of_b.ff_edge_face),
                                           of_a.ff_edge_face, of_b.ff_edge_face),
          .ff_edge_face = std::min(of_a.ff_edge_face, of_b.ff_edge_face)};
}

void CriticalAngles::take_lesser(const CriticalAngles& other) {
  ef_vertex_face = std::min(ef_vertex_face, other.ef_vertex_face);
  ef_edge_edge = std::min(ef_edge_edge, other.ef_edge_edge);
  ff_vertex_face = std::min(ff_vertex_face, other.ff_vertex_face);
  ff_edge_edge = std::min(ff_edge_edge, other.ff_edge_edge);
  ff_edge_face = std::min(ff_edge_face, other.ff_edge_face);
}

CriticalAngles critical_angles(const Mixture& mixture) {
  const std::vector<MixtureKind>& kinds = mixture.kinds();
  CriticalAngles least = critical_angles(*mixture.solid());
  for (std::size_t a = 0; a < kinds.size(); ++a) {
    for (std::size_t b = a; b < kinds.size(); ++b) least.take_lesser(critical_angles(*kinds[a].solid, *kinds[b].solid));
  }
  return least;
}

}  // namespace isojam
