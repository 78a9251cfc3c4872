#include "engine/geometry/planar_faces.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace isojam {

namespace {

constexpr double planar = 1e-30;  ///< largest distance from a plane, relative to the size
constexpr int most_steps = 12;

Quad magnitude(Quad x) { return x < 0 ? -x : x; }

/// One equation: the corner `vertex` of `face` is in the plane of the face.
struct Incidence {
  int face, vertex;
};

std::vector<Incidence> incidences(std::span<const FaceLoop> faces) {
  std::vector<Incidence> all;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    for (const int v : faces[static_cast<std::size_t>(f)]) all.push_back({f, v});
  }
  return all;
}

/// Vertices and planes, with lengths in units of the size.
struct Realisation {
  std::vector<Quad3> vertices;
  std::vector<FacePlane> planes;

  const Quad3& vertex(const Incidence& at) const { return vertices[static_cast<std::size_t>(at.vertex)]; }
  const FacePlane& plane(const Incidence& at) const { return planes[static_cast<std::size_t>(at.face)]; }
  Quad residual(const Incidence& at) const { return dot(plane(at).normal, vertex(at)) - plane(at).offset; }
};

Quad largest_residual(const Realisation& solid, const std::vector<Incidence>& equations) {
  Quad largest = 0;
  for (const Incidence& at : equations) largest = std::max(largest, magnitude(solid.residual(at)));
  return largest;
}

/// J Jᵀ. The equation of a vertex and a plane has the derivatives n, v and −1 by the vertex and by the plane. The
/// product of two equations is thus n·n′ if they have the vertex in common, and v·v′ + 1 if they have the plane in
/// common.
Eigen::MatrixXd normal_matrix(const Realisation& solid, const std::vector<Incidence>& equations) {
  const auto n = static_cast<Eigen::Index>(equations.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index r = 0; r < n; ++r) {
    for (Eigen::Index c = 0; c <= r; ++c) {
      const Incidence &p = equations[static_cast<std::size_t>(r)], &q = equations[static_cast<std::size_t>(c)];
      Quad product = 0;
      if (p.vertex == q.vertex) product += dot(solid.plane(p).normal, solid.plane(q).normal);
      if (p.face == q.face) product += dot(solid.vertex(p), solid.vertex(q)) + 1;
      matrix(r, c) = static_cast<double>(product);
    }
  }
  return matrix;
}

/// One step of least norm. Returns false if J Jᵀ is singular.
bool step(const std::vector<Incidence>& equations, Realisation& solid) {
  const auto n = static_cast<Eigen::Index>(equations.size());
  Eigen::VectorXd residuals(n);
  for (Eigen::Index r = 0; r < n; ++r) {
    residuals[r] = static_cast<double>(solid.residual(equations[static_cast<std::size_t>(r)]));
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(normal_matrix(solid, equations));
  if (factor.info() != Eigen::Success) return false;
  const Eigen::VectorXd multipliers = factor.solve(residuals);
  const Realisation before = solid;
  for (Eigen::Index r = 0; r < n; ++r) {
    const Incidence& at = equations[static_cast<std::size_t>(r)];
    const Quad multiplier = multipliers[r];
    Quad3& vertex = solid.vertices[static_cast<std::size_t>(at.vertex)];
    FacePlane& plane = solid.planes[static_cast<std::size_t>(at.face)];
    vertex = vertex - multiplier * before.plane(at).normal;
    plane.normal = plane.normal - multiplier * before.vertex(at);
    plane.offset += multiplier;
  }
  for (FacePlane& plane : solid.planes) {
    const Quad length = norm(plane.normal);
    plane.normal = (1 / length) * plane.normal;
    plane.offset /= length;
  }
  return true;
}

/// Steps until the residuals no longer decrease. Returns false if they do not reach `planar`.
bool solve(const std::vector<Incidence>& equations, Realisation& solid) {
  Quad residual = largest_residual(solid, equations);
  for (int k = 0; k < most_steps; ++k) {
    Realisation next = solid;
    if (!step(equations, next)) break;
    const Quad reached = largest_residual(next, equations);
    if (!(reached < residual)) break;
    residual = reached;
    solid = std::move(next);
  }
  return residual <= planar;
}

void expect_convex(std::span<const FaceLoop> faces, const Realisation& solid) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
      if (std::find(faces[f].begin(), faces[f].end(), static_cast<int>(v)) != faces[f].end()) continue;
      if (dot(solid.planes[f].normal, solid.vertices[v]) >= solid.planes[f].offset)
        throw NoSolid("the solid is not convex: a vertex is above a face that does not contain it",
                      NoSolid::Cause::not_planar, static_cast<int>(v));
    }
  }
}

}  // namespace

FacePlane fitted_plane(const FaceLoop& face, std::span<const Quad3> vertices) {
  FacePlane plane;
  Quad3 centre{};
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Quad3& p = vertices[static_cast<std::size_t>(face[k])];
    plane.normal = plane.normal + cross(p, vertices[static_cast<std::size_t>(face[(k + 1) % face.size()])]);
    centre = centre + p;
  }
  plane.normal = (1 / norm(plane.normal)) * plane.normal;
  plane.offset = dot(plane.normal, centre) / Quad(face.size());
  return plane;
}

PlanarSolid with_planar_faces(std::span<const Quad3> vertices, std::span<const FaceLoop> faces, Quad allowed_move) {
  PlanarSolid result{{vertices.begin(), vertices.end()}, 0, 0};
  const Quad3 centre = mean_of(vertices);
  Quad size = 0;
  for (const Quad3& v : vertices) size = std::max(size, norm(v - centre));
  Realisation solid;
  for (const Quad3& v : vertices) solid.vertices.push_back((1 / size) * (v - centre));
  for (const FaceLoop& face : faces) solid.planes.push_back(fitted_plane(face, solid.vertices));
  const std::vector<Incidence> equations = incidences(faces);
  result.largest_distance = size * largest_residual(solid, equations);
  if (result.largest_distance > planar * size) {
    const std::vector<Quad3> original = solid.vertices;
    if (!solve(equations, solid)) throw NoSolid("the faces cannot be made planar", NoSolid::Cause::not_planar);
    for (std::size_t v = 0; v < original.size(); ++v) {
      const Quad move = size * norm(solid.vertices[v] - original[v]);
      if (move > allowed_move)
        throw NoSolid("the faces at a vertex cannot be made planar by a small move", NoSolid::Cause::not_planar,
                      static_cast<int>(v));
      result.largest_move = std::max(result.largest_move, move);
      result.vertices[v] = centre + size * solid.vertices[v];
    }
  }
  expect_convex(faces, solid);
  return result;
}

}  // namespace isojam
