#include "tests/oracle/defined_solids.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "engine/geometry/repair.hpp"
#include "tasks/extras/chart/pairs/clip_polytope.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"
#include "tests/oracle/exact_solid.hpp"

namespace isojam::oracle {

namespace {

using Eigen::Vector3d;

constexpr std::array bases{"dodecahedron",         "truncated_tetrahedron",
                           "cuboctahedron",        "rhombic_dodecahedron",
                           "truncated_octahedron", "prism7",
                           "antiprism5",           "cube"};

constexpr std::array writings{Writing{"as_computed"},
                              Writing{"at_1e4", 1, 1e4},
                              Writing{"at_1e6", 1, 1e6},
                              Writing{"at_1e8", 1, 1e8},
                              Writing{"nanometres", 1e-9},
                              Writing{"large", 3e8},
                              Writing{"digits_6", 1, 0, 6, 1e-4},
                              Writing{"digits_9", 1, 0, 9, 1e-7},
                              Writing{"digits_12", 1, 0, 12, 1e-10},
                              Writing{"digits_15", 1, 0, 15, 1e-13},
                              Writing{"digits_9_split", 1, 0, 9}};

double written(double x, int digits) { return std::strtod(fmt::format("{:.{}e}", x, digits - 1).c_str(), nullptr); }

Real exact(const DoubleDouble& x) { return Real(x.high) + Real(x.low); }

RealVector exact(const DoubleDouble& x, const DoubleDouble& y, const DoubleDouble& z) {
  return {exact(x), exact(y), exact(z)};
}

/// Six times the volume and 24 times the first moment, by tetrahedra about the first vertex.
std::pair<Real, RealVector> moments(const RealBody& body) {
  Real volume = 0;
  RealVector moment = RealVector::Zero();
  const RealVector origin = body.vertices[0];
  for (const auto& face : body.faces) {
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const RealVector p = body.vertices[face[0]] - origin, q = body.vertices[face[k]] - origin,
                       r = body.vertices[face[k + 1]] - origin;
      const Real six = p.dot(q.cross(r));
      volume += six;
      moment += six * (p + q + r);
    }
  }
  return {volume, moment};
}

RealQuaternion quaternion(const Pose& pose) {
  std::array<Real, 4> q;  // x, y, z, w
  for (int c = 0; c < 4; ++c) q[static_cast<std::size_t>(c)] = exact(pose.component(c));
  return {q[3], q[0], q[1], q[2]};
}

RealVector position(const Pose& pose) { return exact(pose.coordinate(0), pose.coordinate(1), pose.coordinate(2)); }

/// Vertices in the lab frame, relative to the centre of A, as arrays of T.
template <class T, class Convert>
std::vector<std::array<T, 3>> placed(const RealBody& body, const Pose& pose, const Pose& at_a, const Convert& convert) {
  const RationalMatrix rotation = rotation_matrix(quaternion(pose));
  const RealVector shift = position(pose) - position(at_a);
  std::vector<std::array<T, 3>> result;
  for (const RealVector& v : body.vertices) {
    std::array<T, 3>& image = result.emplace_back();
    for (std::size_t r = 0; r < 3; ++r) {
      image[r] = convert(to_rational(shift[static_cast<int>(r)]));
      for (std::size_t c = 0; c < 3; ++c) {
        image[r] = T(image[r] + convert(rotation[r][c]) * convert(to_rational(v[static_cast<int>(c)])));
      }
    }
  }
  return result;
}

template <class T>
std::array<T, 3> cross_product(const std::array<T, 3>& a, const std::array<T, 3>& b, const std::array<T, 3>& c) {
  std::array<T, 3> u, v;
  for (std::size_t k = 0; k < 3; ++k) u[k] = T(b[k] - a[k]), v[k] = T(c[k] - a[k]);
  return {T(u[1] * v[2] - u[2] * v[1]), T(u[2] * v[0] - u[0] * v[2]), T(u[0] * v[1] - u[1] * v[0])};
}

template <class T, class Convert>
ClipPolytope<T> intersection(const testing_pairs::PosedPair& pair, const Convert& convert) {
  const RealBody a = body_of(pair.a), b = body_of(pair.b);
  ClipPolytope<T> result(placed<T>(a, pair.at_a, pair.at_a, convert), a.faces);
  const auto corners = placed<T>(b, pair.at_b, pair.at_a, convert);
  for (const auto& face : b.faces) {
    // Three corners that are far apart, since adjacent ones may be close to each other.
    const auto corner = [&](std::size_t k) { return corners[static_cast<std::size_t>(face[k * face.size() / 3])]; };
    const std::array<T, 3> normal = cross_product<T>(corner(0), corner(1), corner(2)), on = corner(0);
    result.clip(normal, T(normal[0] * on[0] + normal[1] * on[1] + normal[2] * on[2]));
  }
  return result;
}

}  // namespace

const std::vector<DefinedSolid>& defined_solids() {
  static const std::vector<DefinedSolid> solids = [] {
    RandomStream random{81};
    std::vector<DefinedSolid> result;
    for (const char* base : bases) {
      const Eigen::Matrix3d turn = testing_pairs::random_orientation(random).toRotationMatrix();
      for (const Writing& writing : writings) {
        std::vector<Vector3d> points;
        for (const Vector3d& v : (*Solid::named(base))->vertices()) {
          const Vector3d p = writing.scale * (turn * v) + writing.origin * Vector3d(1, -.7, .4);
          points.push_back(p.unaryExpr([&](double x) { return written(x, writing.digits); }));
        }
        const auto vertices = repaired(points, {.merge = writing.merge}).vertices;
        result.push_back({points, writing, Solid::made_of(fmt::format("{}_{}", base, writing.name), vertices)});
      }
    }
    return result;
  }();
  return solids;
}

RealBody body_of(const ConvexSolid& solid) {
  RealBody body;
  const auto& arrays = solid.arrays();
  for (std::size_t v = 0; v < solid.vertices().size(); ++v) {
    body.vertices.push_back(
        exact({arrays.x[v], arrays.x_low[v]}, {arrays.y[v], arrays.y_low[v]}, {arrays.z[v], arrays.z_low[v]}));
  }
  for (const Face& face : solid.faces()) body.faces.push_back(face.vertices);
  return body;
}

RealBody normalised(const DefinedSolid& defined) {
  RealBody body;
  for (const Vector3d& v : defined.given) body.vertices.push_back(v.cast<Real>());
  for (const Face& face : defined.solid->faces()) body.faces.push_back(face.vertices);
  const auto [six, moment] = moments(body);
  const RealVector centroid = body.vertices[0] + moment / (4 * six);
  const Real scale = 1 / cbrt(Real(six / 6));
  for (RealVector& v : body.vertices) v = scale * (v - centroid);
  return body;
}

RealOverlap real_overlap(const testing_pairs::PosedPair& pair) {
  const auto common = intersection<Real>(pair, [](const Rational& x) { return to_real(x); });
  const auto area = common.original_area();
  return {common.volume(), {area[0], area[1], area[2]}};
}

Real rational_volume(const testing_pairs::PosedPair& pair) {
  return to_real(intersection<Rational>(pair, [](const Rational& x) { return x; }).volume());
}

}  // namespace isojam::oracle
