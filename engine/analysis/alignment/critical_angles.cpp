#include "engine/analysis/alignment/critical_angles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace isojam {

namespace {

using Eigen::Vector3d;

constexpr double right_angle = std::numbers::pi / 2;

double angle_between(const Vector3d& u, const Vector3d& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

/// The vertex figure: angles of the edges and of the face normals at a vertex with the axis through it.
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

/// The value that all angles share. Vertices are rounded, so they agree to some ulp of a length over an edge.
double common(const ConvexSolid& solid, const std::vector<double>& angles) {
  double shortest_edge = solid.diameter();
  for (const Edge& edge : solid.edges()) {
    shortest_edge = std::min(shortest_edge, (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).norm());
  }
  const double tolerance = 64 * std::numeric_limits<double>::epsilon() * solid.diameter() / shortest_edge;
  const auto [least, greatest] = std::minmax_element(angles.begin(), angles.end());
  if (*greatest - *least > tolerance) {
    throw std::invalid_argument("critical angles need a solid whose vertices and edges are all alike; " + solid.name() +
                                " is not one");
  }
  return angles.front();
}

}  // namespace

double CriticalAngles::ef_min() const { return std::min(ef_vertex_face, ef_edge_edge); }
double CriticalAngles::ff_min() const { return std::min({ff_vertex_face, ff_edge_edge, ff_edge_face}); }

CriticalAngles critical_angles(const ConvexSolid& solid) {
  std::vector<double> edge_angles, normal_angles;
  for (const VertexFigure& figure : vertex_figures(solid)) {
    edge_angles.insert(edge_angles.end(), figure.edges.begin(), figure.edges.end());
    normal_angles.insert(normal_angles.end(), figure.normals.begin(), figure.normals.end());
  }
  const double half_dihedral = common(solid, dihedral_angles(solid)) / 2;
  const double sine = std::sin(half_dihedral);

  CriticalAngles critical;
  // Vertex-face: the axis of the vertex points along the inward normal of the face.
  critical.ef_vertex_face = right_angle - common(solid, edge_angles);
  critical.ff_vertex_face = common(solid, normal_angles);
  // Edge-edge: the edges cross at a right angle, each pair of faces symmetric about the line of contact.
  critical.ef_edge_edge = right_angle - half_dihedral;
  critical.ff_edge_edge = std::acos(sine * sine);
  // Edge-face: the two faces at the edge are equally steep on the face that it lies in.
  critical.ff_edge_face = right_angle - half_dihedral;
  return critical;
}

}  // namespace isojam
