#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "tests/oracle/exact_overlap.hpp"

namespace isojam::oracle {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Rational = Kernel::Exact_kernel::FT;
static_assert(std::is_same_v<Rational, mpq_class>, "conversion to and from Real goes through GMP");
using RationalVector = std::array<Rational, 3>;
using RationalMatrix = std::array<RationalVector, 3>;  ///< rows

Rational to_rational(const Real& value);
Real to_real(const Rational& value);

Rational dot(const RationalVector& u, const RationalVector& v);
RationalVector cross(const RationalVector& u, const RationalVector& v);
RationalVector operator+(const RationalVector& u, const RationalVector& v);
RationalVector operator-(const RationalVector& u, const RationalVector& v);
RationalVector operator*(const RationalMatrix& m, const RationalVector& v);

/// The matrix of the rotation by q/|q|. It is rational, because its entries are quadratic forms of q divided by |q|².
RationalMatrix rotation_matrix(const RealQuaternion& q);

/// A half-space: the points y with normal·y ≤ offset. The normal may have any length.
struct RationalPlane {
  RationalVector normal;
  Rational offset;
};

/// A named solid with rational vertices, whose faces are exactly planar. Vertices, edges and faces have the same
/// indices as in the engine.
struct ExactSolid {
  std::vector<RationalVector> vertices;
  std::vector<RationalPlane> planes;
  std::vector<std::vector<int>> faces;  ///< indices of the vertices of each face, counter-clockwise seen from outside
  std::vector<Edge> edges;
  std::vector<std::uint32_t> vertex_planes;  ///< for each vertex: bit i is set if it lies on face i
};

/// The only object for this solid. Throws the std::logic_error of exact_overlap().
const ExactSolid& exact_solid(SolidKind kind);

/// The solid with each point y replaced by rotation·y + displacement.
ExactSolid moved(const ExactSolid& solid, const RationalMatrix& rotation, const RationalVector& displacement);

}  // namespace isojam::oracle
