#include "tasks/extras/chart/pairs/reference_overlap.hpp"

#include "tasks/extras/chart/pairs/clip_polytope.hpp"

namespace isojam::oracle {
namespace {

using Vector = std::array<Digits50, 3>;

Digits50 dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

Vector operator*(const std::array<Vector, 3>& m, const Vector& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

Digits50 sum(double high, double low) { return Digits50(high) + Digits50(low); }

std::array<Vector, 3> rotation(const Eigen::Quaterniond& q) {
  const Digits50 w(q.w()), x(q.x()), y(q.y()), z(q.z()), one(1);
  const Digits50 s = 2 / (w * w + x * x + y * y + z * z);
  return {Vector{one - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
          Vector{s * (x * y + w * z), one - s * (x * x + z * z), s * (y * z - w * x)},
          Vector{s * (x * z - w * y), s * (y * z + w * x), one - s * (x * x + y * y)}};
}

}  // namespace

ReferenceOverlap reference_overlap(const PairCase& pair) {
  const ConvexSolid& solid = platonic(pair.a);
  const SolidArrays &a = solid.arrays(), &b = platonic(pair.b).arrays();
  std::vector<Vector> vertices;
  for (int v = 0; v < a.vertices; ++v)
    vertices.push_back({sum(a.x[v], a.x_low[v]), sum(a.y[v], a.y_low[v]), sum(a.z[v], a.z_low[v])});
  std::vector<std::vector<int>> faces;
  for (const Face& face : solid.faces()) faces.push_back(face.vertices);
  ClipPolytope<Digits50> body(vertices, faces);
  const auto turn = rotation(pair.quaternion);
  const Vector shift{Digits50(pair.displacement.x()), Digits50(pair.displacement.y()), Digits50(pair.displacement.z())};
  for (int f = 0; f < b.faces; ++f) {
    const Vector normal =
        turn * Vector{sum(b.nx[f], b.nx_low[f]), sum(b.ny[f], b.ny_low[f]), sum(b.nz[f], b.nz_low[f])};
    body.clip(normal, sum(b.offset[f], b.offset_low[f]) + dot(normal, shift));
  }
  // S_A is the vector area of the faces of A inside B: if A moves, these faces sweep the gained volume.
  return {body.volume(), body.original_area()};
}

}  // namespace isojam::oracle
