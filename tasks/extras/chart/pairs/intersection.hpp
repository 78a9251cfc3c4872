#pragma once

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "tasks/extras/chart/pairs/clip_polytope.hpp"

namespace isojam {

/// The vector v, rotated by q/|q| of the pose. This is a rational function of the components of q, so it is exact if T
/// is.
template <class T>
std::array<T, 3> rotated(const Pose& pose, const std::array<T, 3>& v) {
  const auto q = [&](int c) { return T(T(pose.component(c).high) + T(pose.component(c).low)); };
  const T x = q(0), y = q(1), z = q(2), w = q(3), s = T(2 / (w * w + x * x + y * y + z * z));
  const std::array<T, 3> t{T(y * v[2] - z * v[1]), T(z * v[0] - x * v[2]), T(x * v[1] - y * v[0])};  // q×v
  return {T(v[0] + s * (w * t[0] + y * t[2] - z * t[1])), T(v[1] + s * (w * t[1] + z * t[0] - x * t[2])),
          T(v[2] + s * (w * t[2] + x * t[1] - y * t[0]))};
}

/// The half-space of face f of a solid in a pose whose position is relative to `centre`.
template <class T>
HalfSpace<T> half_space(const ConvexSolid& solid, int f, const Pose& pose, const Pose& centre) {
  const auto sum = [](double high, double low) { return T(T(high) + T(low)); };
  const SolidArrays& a = solid.arrays();
  HalfSpace<T> moved{
      rotated<T>(pose, {sum(a.nx[f], a.nx_low[f]), sum(a.ny[f], a.ny_low[f]), sum(a.nz[f], a.nz_low[f])}),
      sum(a.offset[f], a.offset_low[f])};
  for (int c = 0; c < 3; ++c) {
    const DoubleDouble here = pose.coordinate(c), origin = centre.coordinate(c);
    moved.offset +=
        moved.normal[static_cast<std::size_t>(c)] * T(sum(here.high, here.low) - sum(origin.high, origin.low));
  }
  return moved;
}

/// A solid in a pose, with its centre as origin. The sides have the numbers of the faces. The vertices have errors of
/// 1e-32.
template <class T>
ClipPolytope<T> polytope(const ConvexSolid& solid, const Pose& pose) {
  const auto sum = [](double high, double low) { return T(T(high) + T(low)); };
  const SolidArrays& a = solid.arrays();
  std::vector<typename ClipPolytope<T>::Side> sides;
  for (const Face& face : solid.faces()) {
    sides.push_back({{}, static_cast<int>(sides.size())});
    for (const int v : face.vertices)
      sides.back().corners.push_back(
          rotated<T>(pose, {sum(a.x[v], a.x_low[v]), sum(a.y[v], a.y_low[v]), sum(a.z[v], a.z_low[v])}));
  }
  return ClipPolytope<T>(std::move(sides));
}

/// The intersection of two solids, with the centre of A as origin: A is cut by the planes of all faces of B. The sides
/// have the numbers of the faces of A, followed by those of B.
template <class T>
ClipPolytope<T> intersection(const ConvexSolid& a, const Pose& at_a, const ConvexSolid& b, const Pose& at_b) {
  ClipPolytope<T> body = polytope<T>(a, at_a);
  for (int f = 0; f < b.arrays().faces; ++f) body.clip(half_space<T>(b, f, at_b, at_a), a.arrays().faces + f);
  return body;
}

}  // namespace isojam
