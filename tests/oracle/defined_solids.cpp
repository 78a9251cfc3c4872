#include "tests/oracle/defined_solids.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "engine/geometry/repair.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

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
  const Real scale = pow(Real(six / 6), Real(-1) / 3);
  for (RealVector& v : body.vertices) v = scale * (v - centroid);
  return body;
}

}  // namespace isojam::oracle
