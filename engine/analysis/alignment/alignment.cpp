#include "engine/analysis/alignment/alignment.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A face normal or an edge of a body in a contact, with its direction in the body frame of A.
struct Direction {
  int index = 0;
  Vector3d unit;
};

struct EdgeFace {
  double angle = 0;
  int edge = -1, face = -1;
};

template <class UnitVector>
std::vector<Direction> directions(const FeatureSet& features, const Matrix3d& rotation, const UnitVector& unit) {
  std::vector<Direction> result;
  result.reserve(static_cast<std::size_t>(features.count()));
  features.for_each([&](int index) { result.push_back({index, rotation * unit(static_cast<std::size_t>(index))}); });
  return result;
}

std::vector<Direction> normals(const ConvexSolid& solid, const FeatureSet& faces, const Matrix3d& rotation) {
  return directions(faces, rotation, [&](std::size_t i) -> Vector3d {
    assert(i < solid.faces().size());
    return solid.faces()[i].normal;
  });
}

std::vector<Direction> edge_directions(const ConvexSolid& solid, const FeatureSet& edges, const Matrix3d& rotation) {
  return directions(edges, rotation, [&](std::size_t e) -> Vector3d {
    assert(e < solid.edges().size());
    const Edge& edge = solid.edges()[e];
    return (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).normalized();
  });
}

// Both angles are computed by atan2 from sine and cosine. This is accurate also where arccos (at 0) and arcsin (at π/2)
// would lose half of the digits.
double opposing_angle(const Vector3d& n, const Vector3d& m) { return nearest::atan2(n.cross(m).norm(), -n.dot(m)); }
double elevation(const Vector3d& e, const Vector3d& n) { return nearest::atan2(std::abs(e.dot(n)), e.cross(n).norm()); }

std::optional<EdgeFace> best_edge_face(const std::vector<Direction>& edges, const std::vector<Direction>& faces) {
  std::optional<EdgeFace> best;
  for (const Direction& edge : edges) {
    for (const Direction& face : faces) {
      const double angle = elevation(edge.unit, face.unit);
      if (!best || angle < best->angle) best = EdgeFace{angle, edge.index, face.index};
    }
  }
  return best;
}

}  // namespace

Alignment alignment(const ConvexSolid& a, const ConvexSolid& b, const Contact& contact) {
  const Overlap& overlap = contact.overlap;
  const Matrix3d identity = Matrix3d::Identity();
  const std::vector<Direction> faces_a = normals(a, overlap.faces_a, identity);
  const std::vector<Direction> faces_b = normals(b, overlap.faces_b, contact.pose.rotation);

  Alignment result;
  result.face_face = std::numbers::pi;
  for (const Direction& of_a : faces_a) {
    for (const Direction& of_b : faces_b) {
      const double angle = opposing_angle(of_a.unit, of_b.unit);
      if (result.face_a < 0 || angle < result.face_face) {
        result.face_face = angle;
        result.face_a = of_a.index;
        result.face_b = of_b.index;
      }
    }
  }

  result.edge_face = std::numbers::pi / 2;
  const auto of_a = best_edge_face(edge_directions(a, overlap.edges_a, identity), faces_b);
  const auto of_b = best_edge_face(edge_directions(b, overlap.edges_b, contact.pose.rotation), faces_a);
  if (!of_a && !of_b) return result;
  result.edge_of_a = of_a && (!of_b || of_a->angle <= of_b->angle);
  const EdgeFace& best = result.edge_of_a ? *of_a : *of_b;
  result.edge_face = best.angle;
  result.edge = best.edge;
  result.face = best.face;
  return result;
}

std::vector<Alignment> alignments(const Composition& solids, std::span<const Contact> contacts) {
  std::vector<Alignment> result;
  result.reserve(contacts.size());
  for (const Contact& contact : contacts)
    result.push_back(alignment(solids[contact.pair.a], solids[contact.pair.b], contact));
  return result;
}

}  // namespace isojam
